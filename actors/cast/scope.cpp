#include "castor/actors/cast/scope.hpp"

#include "castor/base/suggestion.hpp"
#include "castor/base/text.hpp"

#include <utility>

namespace castor::cast {

namespace {

constexpr std::size_t longest_name_in_remedy = 80;
constexpr const char* too_long_remedy = "look for variables that contain others several times over";

} // namespace

void report_undefined_host(const HostTable& hosts, std::string_view name, const SourceLine& line,
                           DiagnosticLog& log) {
  std::string remedy;
  if (log.has_room(Severity::warning))
    remedy = did_you_mean(name, hosts.names(most_candidates));
  if (remedy.empty())
    remedy = "define it before the first section: HOSTNAME " +
             shorten(name, longest_name_in_remedy) + " address";
  log.report(Severity::warning, line,
             "host " + in_quotes(name) + " is not defined; localhost is used", std::move(remedy));
}

Scope::Scope(const Limits& limits, DiagnosticLog& log)
  : limits_(limits), log_(log), budget_(limits.expanded_bytes) {
  // nop
}

std::optional<std::string> Scope::expand(const SourceLine& line, std::string_view text,
                                         Undefined undefined, Remarks remarks) {
  auto expansion = cast::expand(text, variables_, hosts_, undefined, limits_.line_bytes);
  // One byte too many, so that there is one place which refuses long text.
  if (expansion.too_long)
    expansion.text.resize(limits_.line_bytes + 1);
  if (!admit(line, expansion.text))
    return std::nullopt;
  if (remarks == Remarks::yes) {
    for (auto name : expansion.undefined_variables)
      report_undefined_variable(line, name, undefined);
    for (auto name : expansion.undefined_hosts) {
      report_undefined_host(hosts_, name, line, log_);
      hosts_.mark_used(name);
    }
    if (expansion.uses_localhost)
      hosts_.mark_used("localhost");
  }
  return std::move(expansion.text);
}

bool Scope::admit(const SourceLine& line, std::string_view text) {
  if (text.size() > budget_) {
    exhausted_ = true;
    log_.report(Severity::error, line,
                "replacement of variables has produced more than " +
                  std::to_string(limits_.expanded_bytes) + " bytes",
                too_long_remedy);
    return false;
  }
  budget_ -= text.size();
  if (text.size() > limits_.line_bytes) {
    log_.report(Severity::error, line,
                "with its variables replaced, the text is longer than " +
                  std::to_string(limits_.line_bytes) + " bytes",
                too_long_remedy);
    return false;
  }
  return true;
}

void Scope::report_undefined_variable(const SourceLine& line, std::string_view name,
                                      Undefined undefined) {
  std::string remedy;
  if (log_.has_room(Severity::warning))
    remedy = did_you_mean(name, variables_.names(most_candidates));
  if (remedy.empty() && is_identifier(name))
    remedy =
      "define it before this line: VARDEFAULT " + shorten(name, longest_name_in_remedy) + "=value";
  log_.report(Severity::warning, line,
              "variable " + in_quotes(name) + " is not defined; " +
                (undefined == Undefined::keep ? "the text stays as it is" : "it counts as empty"),
              std::move(remedy));
}

} // namespace castor::cast
