#pragma once

#include "castor/actors/cast/description.hpp"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace castor::cli {

/// How commands that take a .cast file take it.
struct ArchitectureArguments {
  std::string file;
  /// name=value
  std::vector<std::string> variables;
};

/// Adds FILE and --set to a command.
void add_architecture_arguments(CLI::App& command, ArchitectureArguments& arguments);

/// Of --set.
std::map<std::string, std::string> variables_of(const ArchitectureArguments& arguments);

/// Reads the file, prints every finding to standard error and, if `expand`, the file's `#EXPAND`
/// comments to standard output. Nothing if there were errors.
std::optional<ArchitectureDescription> read_architecture(const ArchitectureArguments& arguments,
                                                         bool expand = false);

} // namespace castor::cli
