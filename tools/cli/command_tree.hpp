#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

/// The command line of a program as plain data, read from its CLI11 definitions. Completion and
/// manual pages are made from it, so that they agree with `--help`.
namespace castor::cli {

/// Kinds of values that a shell can complete.
enum class ValueKind {
  flag,   // takes no value
  text,   // anything: there is nothing to offer
  choice, // one of `Argument::choices`
  file,
  folder,
  system, // the name of a running system
  place,  // a subarchitecture of a running system, with or without a type of entries
};

/// An option, a flag, or a positional argument.
struct Argument {
  /// As written on the command line, dashes included; empty for a positional argument.
  std::vector<std::string> names;
  /// Placeholder of the value, such as FILE; empty for a flag.
  std::string value;
  std::string help;
  /// Interval of allowed values, in CLI11's wording; often empty.
  std::string range;
  std::string default_value;
  ValueKind kind = ValueKind::flag;
  std::vector<std::string> choices;
  /// Files with this suffix are offered first; without the dot, often empty.
  std::string suffix;
  bool required = false;
  bool repeatable = false;
};

struct Command {
  /// From the program's name to its own: {"castor", "journal", "show"}.
  std::vector<std::string> path;
  std::string help;
  std::string footer;
  std::vector<Argument> options;
  std::vector<Argument> positionals;
  /// Options of the parent commands, which are accepted here, too.
  std::vector<Argument> inherited;
  std::vector<Command> commands;
};

/// Leaves out what is hidden from `--help`.
Command command_tree(const CLI::App& app, const std::string& program);

/// The command and all its subcommands, itself first.
std::vector<const Command*> all_commands(const Command& command);

} // namespace castor::cli
