#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace castor::test {

/// Which files include which, by their paths below the root of the sources, which are those that
/// `#include "castor/..."` has.
using IncludeGraph = std::map<std::string, std::vector<std::string>>;

/// The folders of the product: all that are not hidden, but for the build's, benchmarks,
/// documentation and tests.
std::vector<std::string> product_folders(const std::filesystem::path& root);

/// Of the headers and sources in these folders. Throws std::runtime_error if one cannot be read.
IncludeGraph include_graph(const std::filesystem::path& root,
                           const std::vector<std::string>& folders);

/// A folder, and those whose headers its files may include besides its own.
using Modules = std::map<std::string, std::set<std::string>>;

/// "a/x.cpp includes b/y.hpp" for each include that leads to a folder that the file's does not
/// depend on, in the order of files. Files in none of the folders may include everything.
std::vector<std::string> forbidden_includes(const IncludeGraph& graph, const Modules& modules);

/// The groups of files that include one another in a circle, a header and its source counting as
/// one, without ".hpp" and ".cpp"; sorted.
std::vector<std::vector<std::string>> circles(const IncludeGraph& graph);

} // namespace castor::test
