#pragma once

#include "castor/actors/cast/diagnostic.hpp"

#include <filesystem>
#include <fstream>
#include <vector>

namespace castor::cli {

/// To standard error.
void print(const std::vector<cast::Diagnostic>& problems);

/// A file to be written anew. Throws std::runtime_error.
std::ofstream create(const std::filesystem::path& file);

} // namespace castor::cli
