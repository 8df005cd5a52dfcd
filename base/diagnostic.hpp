#pragma once

#include "castor/base/source_location.hpp"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace castor {

enum class Severity {
  /// There is no description: what the file means is not certain.
  error,
  /// The file runs, perhaps not as its author thinks.
  warning,
  note
};

std::string_view to_string(Severity severity) noexcept;

/// One finding in a text that people write: a `.cast` file, a scene, a lexicon.
struct Diagnostic {
  Severity severity = Severity::error;
  SourceLocation where;
  /// The offending line as written, shortened if it is very long; empty if the file as a whole is
  /// meant.
  std::string line;
  /// The same line after replacement of variables; empty if that changed nothing.
  std::string expanded;
  std::string message;
  /// What to write instead; may be empty.
  std::string remedy;
  /// Place in the line, in bytes from 1; 0 if the whole line is meant.
  std::size_t column = 0;

  friend bool operator==(const Diagnostic&, const Diagnostic&) = default;
};

bool has_errors(const std::vector<Diagnostic>& diagnostics);

/// Brings findings of several checks into the order of the lines that they are about; those about a
/// whole file, or about none, come first.
void sort_by_line(std::vector<Diagnostic>& diagnostics);

/// The finding as text of several lines for a terminal: place and message, include chain, the line,
/// the remedy. Control characters from the file are made visible. Ends with a line break.
/// @param coloured uses ANSI escape sequences
std::string render(const Diagnostic& diagnostic, bool coloured = false);

/// All of them, one after the other.
std::string render(const std::vector<Diagnostic>& diagnostics, bool coloured = false);

} // namespace castor
