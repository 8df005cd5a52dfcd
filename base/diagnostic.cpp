#include "castor/base/diagnostic.hpp"

#include "castor/base/text.hpp"

#include <algorithm>
#include <utility>

namespace castor {

namespace {

std::string_view colour_of(Severity severity) noexcept {
  switch (severity) {
    case Severity::error:
      return "\x1b[1;31m";
    case Severity::warning:
      return "\x1b[1;35m";
    case Severity::note:
      return "\x1b[1;36m";
  }
  return "";
}

} // namespace

std::string_view to_string(Severity severity) noexcept {
  switch (severity) {
    case Severity::error:
      return "error";
    case Severity::warning:
      return "warning";
    case Severity::note:
      return "note";
  }
  return "unknown";
}

bool has_errors(const std::vector<Diagnostic>& diagnostics) {
  return std::ranges::any_of(diagnostics, [](auto& x) { return x.severity == Severity::error; });
}

void sort_by_line(std::vector<Diagnostic>& diagnostics) {
  // Of files without includes, lines have no order but their numbers.
  std::ranges::stable_sort(diagnostics, {}, [](auto& x) {
    return std::pair{x.where.order(), x.where.line()};
  });
}

std::string render(const Diagnostic& diagnostic, bool coloured) {
  std::string_view reset = coloured ? "\x1b[0m" : "";
  std::string_view bold = coloured ? "\x1b[1m" : "";
  std::string_view colour = coloured ? colour_of(diagnostic.severity) : "";
  std::string result;
  auto append = [&result](auto&&... parts) { (result.append(parts), ...); };
  auto place = printable(to_string(diagnostic.where));
  if (diagnostic.column > 0)
    place += ':' + std::to_string(diagnostic.column);
  append(bold, place, ": ", reset, colour, to_string(diagnostic.severity), ": ", reset, bold,
         printable(diagnostic.message), reset, "\n");
  for (const auto& site : diagnostic.where.include_chain())
    append("  included from ", printable(site.file), ":", std::to_string(site.line), "\n");
  if (!diagnostic.line.empty())
    append("    ", printable(diagnostic.line), "\n");
  if (!diagnostic.line.empty() && diagnostic.column > 0) {
    auto before = printable(std::string_view{diagnostic.line}.substr(
      0, std::min(diagnostic.column - 1, diagnostic.line.size())));
    append("    ", std::string(before.size(), ' '), "^\n");
  }
  if (!diagnostic.expanded.empty())
    append("  which expands to\n    ", printable(diagnostic.expanded), "\n");
  if (!diagnostic.remedy.empty())
    append("  remedy: ", printable(diagnostic.remedy), "\n");
  return result;
}

std::string render(const std::vector<Diagnostic>& diagnostics, bool coloured) {
  std::string result;
  for (const auto& diagnostic : diagnostics)
    result += render(diagnostic, coloured);
  return result;
}

} // namespace castor
