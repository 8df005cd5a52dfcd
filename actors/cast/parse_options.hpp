#pragma once

#include "castor/base/file_access.hpp"

#include <cstddef>
#include <functional>
#include <map>
#include <set>
#include <string>

namespace castor::cast {

/// Bounds on what a file may cost. Real files stay far below; beyond them there is an error, never
/// a hang or a full memory.
struct Limits {
  /// Of a line, before and after replacement of variables.
  std::size_t line_bytes = std::size_t{1} << 20;
  /// Of all files together; a file counts each time it is included.
  std::size_t total_bytes = std::size_t{64} << 20;
  /// Of all files together, counted in the same way.
  std::size_t lines = 1'000'000;
  /// Files inside of files.
  std::size_t include_depth = 64;
  /// Of all text that replacement of variables produces.
  std::size_t expanded_bytes = std::size_t{64} << 20;
  /// Besides a closing note.
  std::size_t diagnostics = 200;
};

struct ParseOptions {
  /// Variables that are defined before the first line is read: VARDEFAULT leaves them alone, SETVAR
  /// overwrites them and gets a warning for it.
  /// One that the file, with all it includes, neither defines nor uses is an error.
  std::map<std::string, std::string> variables;
  /// The same, of the program that reads the file: a file need not have them. Those of the same
  /// name in `variables` win.
  std::map<std::string, std::string> offered_variables;
  Environment environment = process_environment;
  FileLoader load = read_file;
  /// What CURRENT_DIR and CONFIG_DIR are relative to; empty means the process's working directory.
  std::string working_directory;
  /// Of a system that runs, which the file is to be joined to: these need neither a WM nor a TM
  /// line in the file, and access rules may name them.
  std::set<std::string, std::less<>> running_subarchitectures;
  Limits limits;
};

} // namespace castor::cast
