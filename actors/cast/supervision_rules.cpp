#include "castor/actors/cast/supervision_rules.hpp"

#include "castor/actors/cast/unknown_name.hpp"
#include "castor/base/duration.hpp"
#include "castor/base/suggestion.hpp"
#include "castor/base/text.hpp"

#include <array>
#include <charconv>
#include <map>
#include <optional>
#include <string_view>
#include <utility>

namespace castor {

std::string_view to_string(RestartStrategy x) noexcept {
  switch (x) {
    case RestartStrategy::one_for_one:
      return "one_for_one";
    case RestartStrategy::one_for_all:
      return "one_for_all";
    case RestartStrategy::rest_for_one:
      return "rest_for_one";
  }
  return {};
}

} // namespace castor

namespace castor::cast {

namespace {

constexpr std::array strategies{RestartStrategy::one_for_one, RestartStrategy::one_for_all,
                                RestartStrategy::rest_for_one};

constexpr std::string_view form =
  "write SUPERVISE who [one_for_one|one_for_all|rest_for_one] [RESTARTS n IN duration] "
  "[DELAY duration TO duration], where who is a subarchitecture, * for all others, or SYSTEM";

std::optional<std::uint32_t> parse_count(std::string_view text) noexcept {
  std::uint32_t result = 0;
  auto end = text.data() + text.size();
  auto [rest, error] = std::from_chars(text.data(), end, result);
  if (error != std::errc{} || rest != end)
    return std::nullopt;
  return result;
}

/// Reads what follows the name; says what is wrong, or nothing.
class PolicyReader {
public:
  explicit PolicyReader(WordStream& words) : words_(words) {}

  std::string read(SupervisionPolicy& policy) {
    while (!words_.peek().empty() && !words_.peek().starts_with('#')) {
      auto word = *words_.next();
      auto problem = word == "RESTARTS" ? restarts(policy)
                     : word == "DELAY"  ? delay(policy)
                                        : strategy(word, policy);
      if (!problem.empty())
        return problem;
    }
    return {};
  }

private:
  std::string strategy(const std::string& word, SupervisionPolicy& policy) {
    std::vector<std::string_view> names{"RESTARTS", "DELAY"};
    for (auto x : strategies) {
      if (word == to_string(x)) {
        policy.strategy = x;
        return {};
      }
      names.push_back(to_string(x));
    }
    auto guess = did_you_mean(word, names);
    return in_quotes(word) + " is no strategy" + (guess.empty() ? "" : "; " + guess);
  }

  std::string restarts(SupervisionPolicy& policy) {
    auto count = parse_count(words_.next().value_or(""));
    if (!count)
      return "RESTARTS takes a whole number";
    if (words_.next() != "IN")
      return "RESTARTS n is followed by IN and a duration";
    auto period = duration();
    if (!period || period->count() == 0)
      return "IN takes a duration such as 10s";
    policy.restarts = *count;
    policy.period = *period;
    return {};
  }

  std::string delay(SupervisionPolicy& policy) {
    auto first = duration();
    if (!first)
      return "DELAY takes a duration such as 100ms";
    if (words_.next() != "TO")
      return "DELAY duration is followed by TO and a duration";
    auto longest = duration();
    if (!longest || *longest < *first)
      return "TO takes a duration that is no shorter than the first";
    policy.first_delay = *first;
    policy.longest_delay = *longest;
    return {};
  }

  std::optional<std::chrono::milliseconds> duration() {
    return parse_duration(words_.next().value_or(""));
  }

  WordStream& words_;
};

} // namespace

void SupervisionRules::read_supervise(WordStream& words, const StructureLine& line,
                                      DiagnosticLog& log) {
  auto who = words.next();
  std::string problem = "SUPERVISE without a name";
  SupervisionRule rule{who.value_or(""), {}, line.line->where()};
  if (is_given(who))
    problem = PolicyReader{words}.read(rule.policy);
  if (!problem.empty()) {
    log.report(Severity::error, *line.line, problem, std::string{form}, line.text);
    return;
  }
  rules_.push_back(std::move(rule));
  rule_lines_.push_back(&line);
}

void SupervisionRules::read_failover(WordStream& words, const StructureLine& line,
                                     DiagnosticLog& log,
                                     const std::function<std::string(std::string_view)>& use_host) {
  auto who = words.next();
  auto to = words.next();
  FailoverRule rule{who.value_or(""), {}, line.line->where()};
  while (!words.peek().empty() && !words.peek().starts_with('#'))
    rule.hosts.push_back(use_host(*words.next()));
  if (!is_given(who) || to != "TO" || rule.hosts.empty()) {
    log.report(Severity::error, *line.line, "this FAILOVER line is incomplete",
               "write FAILOVER who TO host [host...], where who is a subarchitecture or a "
               "component",
               line.text);
    return;
  }
  failovers_.push_back(std::move(rule));
  failover_lines_.push_back(&line);
}

void SupervisionRules::finish(const std::set<std::string, std::less<>>& subarchitectures,
                              ArchitectureDescription& to, DiagnosticLog& log) {
  std::map<std::string_view, const StructureLine*> seen;
  for (std::size_t i = 0; i < rules_.size(); ++i) {
    auto& line = *rule_lines_[i];
    auto& who = rules_[i].who;
    if (who != "*" && who != SupervisionRule::system && subarchitectures.count(who) == 0)
      report_unknown(who, subarchitectures, "there is no subarchitecture " + in_quotes(who),
                     "write the name of a subarchitecture, * or SYSTEM", line, log);
    auto [first, is_new] = seen.try_emplace(who, &line);
    if (!is_new)
      log.report(Severity::error, *line.line,
                 who + " has a SUPERVISE line at " + to_string(first->second->line->where()) +
                   " already",
                 "remove one of the lines", line.text);
  }
  // Components that are no working memories: those go where their subarchitectures go.
  std::set<std::string, std::less<>> movable{subarchitectures};
  for_each_component(to, [&](const ComponentDescription& x) {
    if (x.kind == ComponentKind::working_memory || x.kind == ComponentKind::task_manager)
      return;
    movable.insert(x.name);
  });
  for (std::size_t i = 0; i < failovers_.size(); ++i)
    if (auto& who = failovers_[i].who; movable.count(who) == 0)
      report_unknown(
        who, movable, "there is neither a subarchitecture nor a component " + in_quotes(who),
        "write the name of a subarchitecture or a component", *failover_lines_[i], log);
  to.supervision = std::move(rules_);
  to.failover = std::move(failovers_);
}

} // namespace castor::cast
