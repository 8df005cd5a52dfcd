#include "castor/tools/chaos/recorded_actions.hpp"

#include "castor/tools/chaos/read_logs.hpp"
#include "castor/tools/chaos/rounded.hpp"

#include <fmt/core.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdint>
#include <map>
#include <set>

namespace castor::faults {

namespace {

std::string describe(const Life& x) {
  return fmt::format("{} (incarnation {})", x.first, x.second);
}

} // namespace

void read_actions(std::istream& in, std::vector<ExecutedAction>& to) {
  for (std::string text; std::getline(in, text);) {
    const auto line = nlohmann::json::parse(text, nullptr, false);
    if (!line.is_object() || !line.contains("executes"))
      continue;
    auto& x = to.emplace_back();
    x.executor = {line.at("executes").get<std::string>(), line.at("life").get<std::uint64_t>()};
    x.type = line.at("type").get<std::string>();
    x.at = line.at("at").get<linearizability::Tick>();
    x.action = {line.at("where").get<std::string>(), line.at("id").get<std::string>()};
  }
}

std::vector<ExecutedAction> read_actions(const std::filesystem::path& folder) {
  std::vector<ExecutedAction> result;
  read_logs(folder, [&](std::istream& in) { read_actions(in, result); });
  return result;
}

Judgement judge_actions(std::vector<ExecutedAction> actions) {
  Judgement result;
  std::ranges::stable_sort(actions, {}, &ExecutedAction::at);
  std::map<Address, const ExecutedAction*> first;
  std::set<std::string> types;
  for (const auto& x : actions) {
    types.insert(x.type);
    const auto [place, is_new] = first.emplace(x.action, &x);
    if (is_new)
      continue;
    result.verdict = linearizability::Verdict::Kind::violation;
    result.report +=
      fmt::format("{} executed the {} {}, which {} had begun before\n", describe(x.executor),
                  x.type, to_string(x.action), describe(place->second->executor));
  }
  result.grounds = fmt::format("{} of {}", counted(first.size(), "action", "actions"),
                               counted(types.size(), "type", "types"));
  return result;
}

} // namespace castor::faults
