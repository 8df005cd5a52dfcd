#include "castor/tools/chaos/recorded_commands.hpp"

#include "castor/actors/runtime/command_gate.hpp"
#include "castor/tools/chaos/read_logs.hpp"
#include "castor/tools/chaos/rounded.hpp"

#include <fmt/core.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <map>
#include <tuple>

namespace castor::faults {

namespace {

using namespace linearizability;

/// A lease as its holder was told of it.
struct Grant {
  Life holder;
  Token token = 0;
  /// When it had been granted at the latest.
  Tick by = 0;
};

std::map<Address, std::vector<Grant>> grants_in(const Recording& recording) {
  std::map<Address, std::vector<Grant>> result;
  for (auto& x : recording) {
    auto& record = x.record;
    if (record.locks() && !record.pending() && record.result.status == Status::ok &&
        !x.says_nothing)
      result[x.address].push_back({{x.component, x.life}, record.result.token, record.returned});
  }
  return result;
}

std::string describe(const ObeyedCommand& x) {
  return fmt::format("{} obeyed a {} of {} (incarnation {}, token {})", x.effector, x.type,
                     x.commander.first, x.commander.second, x.token);
}

Timestamp between(Tick from, Tick to) {
  return std::chrono::duration_cast<Timestamp>(
    std::chrono::nanoseconds{static_cast<std::int64_t>(to - from)});
}

/// What is wrong with a command; empty if nothing is.
std::string violation_of(const ObeyedCommand& x, const std::vector<Grant>& grants) {
  auto own = std::ranges::find_if(
    grants, [&](auto& y) { return y.token == x.token && y.holder == x.commander; });
  if (own == grants.end())
    return fmt::format("{}, but it was never granted that lease of {}", describe(x),
                       to_string(*x.lease));
  constexpr auto trusted = static_cast<Tick>(
    std::chrono::duration_cast<std::chrono::nanoseconds>(CommandGate::trusted_for).count());
  for (auto& y : grants)
    if (y.token > x.token && y.by + trusted < x.at)
      return fmt::format("{} {} after {} had got the lease of {} (token {})", describe(x),
                         rounded(between(y.by, x.at)), y.holder.first, to_string(*x.lease),
                         y.token);
  return {};
}

} // namespace

void read_commands(std::istream& in, std::vector<ObeyedCommand>& to) {
  for (std::string text; std::getline(in, text);) {
    auto line = nlohmann::json::parse(text, nullptr, false);
    if (!line.is_object() || !line.contains("obeys"))
      continue;
    auto& x = to.emplace_back();
    x.effector = line.at("obeys").get<std::string>();
    x.type = line.at("type").get<std::string>();
    x.at = line.at("at").get<Tick>();
    x.commander = {line.at("component").get<std::string>(), line.at("life").get<std::uint64_t>()};
    x.token = line.at("token").get<Token>();
    if (line.contains("where"))
      x.lease = Address{line.at("where").get<std::string>(), line.at("id").get<std::string>()};
  }
}

std::vector<ObeyedCommand> read_commands(const std::filesystem::path& folder) {
  std::vector<ObeyedCommand> result;
  read_logs(folder, [&](std::istream& in) { read_commands(in, result); });
  return result;
}

Judgement judge_commands(std::vector<ObeyedCommand> commands, const Recording& recording) {
  Judgement result;
  auto grants = grants_in(recording);
  std::ranges::stable_sort(commands, {}, &ObeyedCommand::at);
  std::map<std::pair<std::string, std::string>, const ObeyedCommand*> newest;
  std::size_t checked = 0;
  for (auto& x : commands) {
    if (!x.lease)
      continue;
    ++checked;
    auto violation = violation_of(x, grants[*x.lease]);
    auto& before = newest[{x.effector, x.type}];
    if (violation.empty() && before && before->token > x.token)
      violation =
        fmt::format("{} {} after one of {} with token {}", describe(x),
                    rounded(between(before->at, x.at)), before->commander.first, before->token);
    if (!before || before->token <= x.token)
      before = &x;
    if (violation.empty())
      continue;
    result.verdict = Verdict::Kind::violation;
    result.report += violation + '\n';
  }
  result.grounds = fmt::format("{} obeyed, {} of them under a lease",
                               counted(commands.size(), "command", "commands"), checked);
  return result;
}

} // namespace castor::faults
