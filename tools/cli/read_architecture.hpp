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

/// Arguments of commands that read a .cast file.
struct ArchitectureArguments {
  std::string file;
  /// name=value
  std::vector<std::string> variables;
  /// Variables set by the command itself; the file may lack them.
  std::map<std::string, std::string> offered{};
};

/// Adds FILE and --set to a command.
void add_architecture_arguments(CLI::App& command, ArchitectureArguments& arguments);

/// Adds --set alone.
void add_set_option(CLI::App& command, ArchitectureArguments& arguments);

/// The variables of --set. Throws std::runtime_error if one is set twice.
std::map<std::string, std::string> variables_of(const ArchitectureArguments& arguments);

/// Reads the file and prints every finding to standard error, including errors in classes and
/// options of the lines that could be parsed. Nothing if there are errors.
std::optional<ArchitectureDescription> read_architecture(const ArchitectureArguments& arguments);

/// Reads the file, and prints nothing.
cast::ParseResult parse_architecture(const ArchitectureArguments& arguments);

/// All findings about the file, including whether it was meant for `castor add`.
std::vector<Diagnostic> findings_in(cast::ParseResult& parsed,
                                    const ArchitectureArguments& arguments, Classes classes);

} // namespace castor::cli
