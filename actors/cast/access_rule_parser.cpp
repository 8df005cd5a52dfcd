#include "castor/actors/cast/access_rule_parser.hpp"

#include "castor/actors/cast/unknown_name.hpp"
#include "castor/base/text.hpp"
#include "castor/wm/entries/client.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>
#include <string_view>
#include <utility>

namespace castor::cast {

namespace {

/// @param special what may stand instead of the name of a subarchitecture
void check_name(const std::string& name, std::string_view special, const StructureLine& line,
                const std::set<std::string, std::less<>>& subarchitectures, DiagnosticLog& log) {
  if (name == "*" || name == special || subarchitectures.count(name) > 0)
    return;
  std::set<std::string, std::less<>> known;
  // Costs nothing once there are too many errors to be told.
  if (log.has_room(Severity::error))
    known = subarchitectures;
  if (!special.empty())
    known.emplace(special);
  report_unknown(name, known, "there is no subarchitecture " + in_quotes(name),
                 "write the name of a subarchitecture, or * for all", line, log);
}

} // namespace

void AccessRuleParser::read(WordStream& words, const StructureLine& line, DiagnosticLog& log) {
  auto who = words.next();
  auto verb = words.next();
  auto owner = words.next();
  if (!is_given(who) || (verb != "WRITES" && verb != "READS") || !is_given(owner)) {
    log.report(Severity::error, *line.line, "this is no access rule",
               "write ACCESS writer WRITES owner or ACCESS reader READS owner, with names of "
               "subarchitectures or * for all, or ACCESS operator WRITES nothing",
               line.text);
    return;
  }
  words.warn_of_rest();
  if (verb == "READS") {
    read_rules_.push_back({std::move(*who), std::move(*owner), line.line->where()});
    read_lines_.push_back(&line);
    return;
  }
  rules_.push_back({std::move(*who), std::move(*owner), line.line->where()});
  lines_.push_back(&line);
}

void AccessRuleParser::check_operator_rule(std::size_t number, bool joins, DiagnosticLog& log) {
  const auto& line = *lines_[number];
  if (joins)
    log.report(
      Severity::error, *line.line, "the rules for operators are fixed when the system is started",
      "remove the line, or write it into the file that the system is started with", line.text);
  auto is_other = [&](const AccessRule& x) {
    return x.writer == operators && x.owner != AccessRule::nothing;
  };
  if (rules_[number].owner == AccessRule::nothing &&
      std::any_of(rules_.begin(), rules_.end(), is_other))
    log.report(Severity::error, *line.line,
               "operators may write nothing, and another line lets them write",
               "remove one of the lines", line.text);
}

void AccessRuleParser::finish(const std::set<std::string, std::less<>>& subarchitectures,
                              bool joins, ArchitectureDescription& into, DiagnosticLog& log) {
  check_write_rules(subarchitectures, joins, log);
  check_read_rules(subarchitectures, joins, log);
  into.access_rules = std::move(rules_);
  into.read_rules = std::move(read_rules_);
  check_writers_read(into, log);
}

void AccessRuleParser::check_read_rules(const Names& subarchitectures, bool joins,
                                        DiagnosticLog& log) {
  auto is_restricted =
    std::any_of(read_rules_.begin(), read_rules_.end(), [](auto& x) { return x.owner != "*"; });
  std::map<std::pair<std::string_view, std::string_view>, const StructureLine*> seen;
  for (std::size_t i = 0; i < read_rules_.size(); ++i) {
    const auto& [reader, owner, where] = read_rules_[i];
    const auto& line = *read_lines_[i];
    if (joins)
      log.report(
        Severity::error, *line.line, "who may read what is fixed when the system is started",
        "remove the line, or write it into the file that the system is started with", line.text);
    if (reader == operators)
      log.report(Severity::error, *line.line, "operators may read everywhere", "remove the line",
                 line.text);
    else
      check_name(reader, "", line, subarchitectures, log);
    check_name(owner, "", line, subarchitectures, log);
    if (owner == "*" && !is_restricted)
      log.report(Severity::warning, *line.line,
                 "everybody may read everywhere in any case: no rule names an owner",
                 "remove the line", line.text);
    auto [first, is_new] = seen.try_emplace({reader, owner}, &line);
    if (!is_new)
      log.report(Severity::warning, *line.line,
                 "this rule stands at " + to_string(first->second->line->where()) + " already",
                 "remove the line", line.text);
  }
}

void AccessRuleParser::check_writers_read(const ArchitectureDescription& architecture,
                                          DiagnosticLog& log) {
  for (std::size_t i = 0; i < architecture.access_rules.size(); ++i) {
    const auto& [writer, owner, where] = architecture.access_rules[i];
    if (writer == "*" || owner == "*" || writer == operators ||
        architecture.may_read(writer, owner))
      continue;
    log.report(Severity::warning, *lines_[i]->line,
               in_quotes(writer) + " may write to " + in_quotes(owner) +
                 ", but not read there, so it can overwrite only its own entries",
               "add ACCESS " + writer + " READS " + owner, lines_[i]->text);
  }
}

void AccessRuleParser::check_write_rules(const Names& subarchitectures, bool joins,
                                         DiagnosticLog& log) {
  std::map<std::pair<std::string_view, std::string_view>, const StructureLine*> seen;
  for (std::size_t i = 0; i < rules_.size(); ++i) {
    const auto& [writer, owner, where] = rules_[i];
    const auto& line = *lines_[i];
    bool of_operators = writer == operators;
    if (of_operators)
      check_operator_rule(i, joins, log);
    check_name(writer, operators, line, subarchitectures, log);
    if (owner != writer || of_operators)
      check_name(owner, of_operators ? AccessRule::nothing : "", line, subarchitectures, log);
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
}

} // namespace castor::cast
