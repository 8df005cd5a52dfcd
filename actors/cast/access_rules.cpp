#include "castor/actors/cast/access_rules.hpp"

#include "castor/actors/cast/text.hpp"
#include "castor/actors/cast/unknown_name.hpp"

#include <cstddef>
#include <map>
#include <optional>
#include <string_view>
#include <utility>

namespace castor::cast {

namespace {

void check_name(const std::string& name, const StructureLine& line,
                const std::set<std::string, std::less<>>& subarchitectures, DiagnosticLog& log) {
  if (name != "*" && subarchitectures.count(name) == 0)
    report_unknown(name, subarchitectures, "there is no subarchitecture " + in_quotes(name),
                   "write the name of a subarchitecture, or * for all", line, log);
}

} // namespace

void AccessRules::read(WordStream& words, const StructureLine& line, DiagnosticLog& log) {
  auto writer = words.next();
  auto verb = words.next();
  auto owner = words.next();
  if (!is_given(writer) || verb != "WRITES" || !is_given(owner)) {
    log.report(Severity::error, *line.line, "this is no access rule",
               "write ACCESS writer WRITES owner, with names of subarchitectures or * for all",
               line.text);
    return;
  }
  words.warn_of_rest();
  rules_.push_back({std::move(*writer), std::move(*owner), line.line->where()});
  lines_.push_back(&line);
}

std::vector<AccessRule>
AccessRules::finish(const std::set<std::string, std::less<>>& subarchitectures,
                    DiagnosticLog& log) {
  std::map<std::pair<std::string_view, std::string_view>, const StructureLine*> seen;
  for (std::size_t i = 0; i < rules_.size(); ++i) {
    const auto& [writer, owner, where] = rules_[i];
    const auto& line = *lines_[i];
    check_name(writer, line, subarchitectures, log);
    if (owner != writer)
      check_name(owner, line, subarchitectures, log);
    else if (owner != "*")
      log.report(Severity::warning, *line.line,
                 in_quotes(owner) + " may write to its own working memory in any case",
                 "remove the line", line.text);
    auto [first, is_new] = seen.try_emplace({writer, owner}, &line);
    if (!is_new)
      log.report(Severity::warning, *line.line,
                 "this rule stands at " + to_string(first->second->line->where()) + " already",
                 "remove the line", line.text);
  }
  return std::move(rules_);
}

} // namespace castor::cast
