#pragma once

#include "castor/base/diagnostic.hpp"
#include "castor/base/source_line.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace castor {

/// Collects the findings of all passes, sorts them by place in the files and bounds their number:
/// errors are kept before warnings.
class DiagnosticLog {
public:
  /// @param limit maximum number of diagnostics that `take` returns, besides a closing note
  explicit DiagnosticLog(std::size_t limit);

  /// @param expanded the line after replacement of variables, if the caller has it
  void report(Severity severity, const SourceLine& line, std::string message,
              std::string remedy = {}, std::string_view expanded = {});

  /// A finding about a whole file, or about no file.
  void report(Severity severity, const SourceLocation& where, std::string message,
              std::string remedy = {});

  /// Whether another finding of this kind would be kept: lets callers skip costly explanations.
  bool has_room(Severity severity) const noexcept;

  bool has_errors() const noexcept { return error_count_ > 0; }

  /// Ends the collection and returns it in file order.
  std::vector<Diagnostic> take();

private:
  struct Entry {
    std::uint64_t order = 0;
    Diagnostic diagnostic;
  };

  /// Counts the finding.
  /// @returns whether it is to be kept
  bool admit(Severity severity) noexcept;

  void add(std::uint64_t order, Diagnostic diagnostic);

  std::size_t limit_;
  std::size_t error_count_ = 0;
  std::size_t other_count_ = 0;
  std::vector<Entry> errors_;
  std::vector<Entry> others_;
};

} // namespace castor
