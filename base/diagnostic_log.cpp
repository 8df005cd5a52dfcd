#include "castor/base/diagnostic_log.hpp"

#include "castor/base/text.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace castor {

namespace {

constexpr std::size_t longest_shown_line = 400;

} // namespace

DiagnosticLog::DiagnosticLog(std::size_t limit) : limit_(limit) {
  // nop
}

void DiagnosticLog::report(Severity severity, const SourceLine& line, std::string message,
                           std::string remedy, std::string_view expanded) {
  if (!admit(severity))
    return;
  Diagnostic diagnostic{severity, line.where(),       shorten(line.text, longest_shown_line),
                        {},       std::move(message), std::move(remedy)};
  if (!expanded.empty() && expanded != line.text)
    diagnostic.expanded = shorten(expanded, longest_shown_line);
  add(std::uint64_t{line.order} + 1, std::move(diagnostic));
}

void DiagnosticLog::report(Severity severity, const SourceLocation& where, std::string message,
                           std::string remedy) {
  if (admit(severity))
    add(0, {severity, where, {}, {}, std::move(message), std::move(remedy)});
}

bool DiagnosticLog::has_room(Severity severity) const noexcept {
  return (severity == Severity::error ? errors_ : others_).size() < limit_;
}

std::vector<Diagnostic> DiagnosticLog::take() {
  auto by_order = [](const Entry& a, const Entry& b) { return a.order < b.order; };
  std::stable_sort(others_.begin(), others_.end(), by_order);
  if (errors_.size() + others_.size() > limit_)
    others_.resize(limit_ - errors_.size());
  auto hidden = error_count_ + other_count_ - errors_.size() - others_.size();
  std::vector<Entry> entries = std::move(errors_);
  std::move(others_.begin(), others_.end(), std::back_inserter(entries));
  std::stable_sort(entries.begin(), entries.end(), by_order);
  std::vector<Diagnostic> result;
  result.reserve(entries.size() + 1);
  for (auto& entry : entries)
    result.push_back(std::move(entry.diagnostic));
  if (hidden > 0) {
    auto where = result.empty() ? SourceLocation{} : result.back().where;
    result.push_back({Severity::note,
                      std::move(where),
                      {},
                      {},
                      std::to_string(hidden) + " more finding(s) are not listed",
                      "correct the ones above and check again"});
  }
  return result;
}

bool DiagnosticLog::admit(Severity severity) noexcept {
  ++(severity == Severity::error ? error_count_ : other_count_);
  return has_room(severity);
}

void DiagnosticLog::add(std::uint64_t order, Diagnostic diagnostic) {
  auto& entries = diagnostic.severity == Severity::error ? errors_ : others_;
  entries.push_back({order, std::move(diagnostic)});
}

} // namespace castor
