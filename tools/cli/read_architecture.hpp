#pragma once

#include "castor/actors/cast/description.hpp"
#include "castor/actors/cast/parser.hpp"
#include "castor/actors/node/check.hpp"

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
  /// Those that a command sets of itself: the file need not have them.
  std::map<std::string, std::string> offered{};
};

/// Adds FILE and --set to a command.
void add_architecture_arguments(CLI::App& command, ArchitectureArguments& arguments);

/// Adds --set alone.
void add_set_option(CLI::App& command, ArchitectureArguments& arguments);

/// Of --set. Throws std::runtime_error if one is set twice.
std::map<std::string, std::string> variables_of(const ArchitectureArguments& arguments);

/// Reads the file and prints every finding to standard error: with errors, also what is wrong with
/// classes and options of the lines that were understood. Nothing if there were errors.
std::optional<ArchitectureDescription> read_architecture(const ArchitectureArguments& arguments);

/// Reads the file, and prints nothing.
cast::ParseResult parse_architecture(const ArchitectureArguments& arguments);

/// All that is wrong with it, and whether it was meant for `castor add`.
std::vector<Diagnostic> findings_in(cast::ParseResult& parsed,
                                    const ArchitectureArguments& arguments, Classes classes);

} // namespace castor::cli
