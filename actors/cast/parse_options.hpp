#pragma once

#include "castor/base/file_access.hpp"

#include <cstddef>
#include <functional>
#include <map>
#include <set>
#include <string>

namespace castor::cast {

/// Limits on the time and memory that parsing a file takes, far above real files. Exceeding one is
/// an error.
struct Limits {
  /// Of a line, before and after replacement of variables.
  std::size_t line_bytes = std::size_t{1} << 20;
  /// Of all files together; a file counts each time it is included.
  std::size_t total_bytes = std::size_t{64} << 20;
  /// Of all files together, counted in the same way.
  std::size_t lines = 1'000'000;
  /// Depth of nested INCLUDE lines.
  std::size_t include_depth = 64;
  /// Of all text that replacement of variables produces.
  std::size_t expanded_bytes = std::size_t{64} << 20;
  /// Number of diagnostics, besides a closing note.
  std::size_t diagnostics = 200;
};

struct ParseOptions {
  /// Variables that are defined before the first line is read: VARDEFAULT leaves them alone, SETVAR
  /// overwrites them and gets a warning for it.
  /// One that the file, with all it includes, neither defines nor uses is an error.
  std::map<std::string, std::string> variables;
  /// The same, defined by the program that reads the file: unused ones are no error. Those of the
  /// same name in `variables` take precedence.
  std::map<std::string, std::string> offered_variables;
  Environment environment = process_environment;
  FileLoader load = read_file;
  /// What CURRENT_DIR and CONFIG_DIR are relative to; empty means the process's working directory.
  std::string working_directory;
  /// Subarchitectures of the running system that the file is joined to: they need neither a WM nor
  /// a TM line in the file, and access rules may name them.
  std::set<std::string, std::less<>> running_subarchitectures;
  Limits limits;
};

} // namespace castor::cast
