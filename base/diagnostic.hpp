#pragma once

#include "castor/base/source_location.hpp"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace castor {

enum class Severity {
  /// The meaning of the file is not certain, so there is no result.
  error,
  /// The file can be used, but may not do what its author expects.
  warning,
  note
};

std::string_view to_string(Severity severity) noexcept;

/// One finding in a text that people write: a `.cast` file, a scene, a lexicon.
struct Diagnostic {
  Severity severity = Severity::error;
  SourceLocation where;
  /// The line as written, shortened if it is very long; empty for a finding about the whole file.
  std::string line;
  /// The same line after replacement of variables; empty if that changed nothing.
  std::string expanded;
  std::string message;
  /// What to write instead; may be empty.
  std::string remedy;
  /// Column in bytes, from 1; 0 for the whole line.
  std::size_t column = 0;

  friend bool operator==(const Diagnostic&, const Diagnostic&) = default;
};

bool has_errors(const std::vector<Diagnostic>& diagnostics);

/// Sorts the findings of several checks by line; those about a whole file, or about no file, come
/// first.
void sort_by_line(std::vector<Diagnostic>& diagnostics);

/// The finding as text of several lines for a terminal: place and message, include chain, the line,
/// the remedy. Control characters from the file are made visible. Ends with a line break.
/// @param coloured uses ANSI escape sequences
std::string render(const Diagnostic& diagnostic, bool coloured = false);

/// All of them, one after the other.
std::string render(const std::vector<Diagnostic>& diagnostics, bool coloured = false);

} // namespace castor
