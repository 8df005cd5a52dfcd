#include "castor/tools/simulation/campaign_report.hpp"

#include "castor/tools/simulation/system_simulation.hpp"

#include <fmt/core.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace castor::simulation {

namespace {

using Json = nlohmann::ordered_json;

/// Of the layout of the state file, which is refused in any other.
constexpr int format = 1;

/// Counts of a group in one line, the most frequent first.
std::string in_a_line(const Happenings::Counts& counts) {
  std::vector<std::pair<std::string_view, std::uint64_t>> sorted;
  for (auto& [what, times] : counts)
    if (times > 0)
      sorted.emplace_back(what, times);
  std::ranges::stable_sort(sorted, std::ranges::greater{}, [](auto& x) { return x.second; });
  std::string result;
  for (auto& [what, times] : sorted)
    result += fmt::format("{}{} {}", result.empty() ? "" : ", ", what, times);
  return result.empty() ? "none" : result;
}

std::string indented(const std::string& lines) {
  std::string result;
  std::size_t begin = 0;
  while (begin < lines.size()) {
    auto end = std::min(lines.find('\n', begin), lines.size());
    result += "    " + lines.substr(begin, end - begin) + '\n';
    begin = end + 1;
  }
  return result;
}

std::string to_text(const Violation& x) {
  auto result = fmt::format("  seed {}\n{}", x.seed, indented(x.text));
  if (x.faults > 0 && x.plan.empty())
    result += "    It takes none of its faults.\n";
  else if (!x.plan.empty())
    result += fmt::format("    Of its faults, {} in all, these are enough:\n{}", x.faults,
                          indented(indented(x.plan)));
  return result + "    Once more: " + x.command + "\n";
}

std::string verdict_of(const CampaignReport& x) {
  if (!x.held())
    return "violated";
  return x.is_complete() ? "held" : "held so far";
}

} // namespace

void CampaignReport::add(const SystemResult& x) {
  ++done;
  undecided += !x.ok() && !x.is_wrong();
  operations += x.operations;
  steps += x.steps;
  happened.add(x.happened);
}

void CampaignReport::append(CampaignReport next) {
  done += next.done;
  undecided += next.undecided;
  operations += next.operations;
  steps += next.steps;
  happened.add(next.happened);
  std::ranges::move(next.violations, std::back_inserter(violations));
}

std::string to_text(const CampaignReport& x) {
  auto result = fmt::format(
    "{} of {} systems were simulated (seeds {}), {:.0f} a second\n"
    "{} scheduling decisions, {} operations on working memories; the checker could not decide on "
    "{} histories\n",
    x.done, x.seeds.size(), to_string(x.seeds), x.systems_per_second(), x.steps, x.operations,
    x.undecided);
  result += "what happened:\n";
  for (auto& [group, counts] : x.happened.groups())
    result += fmt::format("  {:<12} {}\n", group, in_a_line(counts));
  if (x.done > 0)
    for (auto& what : x.happened.never())
      result += "  never        " + what + "\n";
  if (!x.violations.empty())
    result += "violations:\n";
  for (auto& violation : x.violations)
    result += to_text(violation);
  return result + "verdict: " + verdict_of(x) + "\n";
}

std::string to_json(const CampaignReport& x) {
  Json happened = Json::object();
  for (auto& [group, counts] : x.happened.groups())
    for (auto& [what, times] : counts)
      happened[group][what] = times;
  auto violations = Json::array();
  for (auto& violation : x.violations)
    violations.push_back({{"seed", violation.seed},
                          {"text", violation.text},
                          {"faults", violation.faults},
                          {"plan", violation.plan},
                          {"command", violation.command}});
  return Json{{"format", format},
              {"from", x.seeds.from},
              {"to", x.seeds.to},
              {"done", x.done},
              {"undecided", x.undecided},
              {"operations", x.operations},
              {"steps", x.steps},
              {"seconds", x.elapsed.count()},
              {"systems_per_second", x.systems_per_second()},
              {"happened", happened},
              {"never", x.happened.never()},
              {"violations", violations},
              {"verdict", verdict_of(x)}}
    .dump();
}

CampaignReport from_json(const std::string& text) {
  try {
    auto json = Json::parse(text);
    if (json.at("format") != format)
      throw std::invalid_argument{"it is of another format"};
    CampaignReport result;
    json.at("from").get_to(result.seeds.from);
    json.at("to").get_to(result.seeds.to);
    json.at("done").get_to(result.done);
    json.at("undecided").get_to(result.undecided);
    json.at("operations").get_to(result.operations);
    json.at("steps").get_to(result.steps);
    result.elapsed = std::chrono::duration<double>{json.at("seconds").get<double>()};
    for (auto& [group, counts] : json.at("happened").items())
      for (auto& [what, times] : counts.items())
        result.happened.add(group, what, times.get<std::uint64_t>());
    for (auto& x : json.at("violations"))
      result.violations.push_back(
        {x.at("seed"), x.at("text"), x.at("faults"), x.at("plan"), x.at("command")});
    if (result.seeds.to < result.seeds.from || result.done > result.seeds.size())
      throw std::invalid_argument{"its seeds do not fit together"};
    return result;
  } catch (const Json::exception& e) {
    throw std::invalid_argument{"it is no state of a simulation: " + std::string{e.what()}};
  }
}

} // namespace castor::simulation
