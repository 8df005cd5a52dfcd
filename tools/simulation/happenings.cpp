#include "castor/tools/simulation/happenings.hpp"

#include "castor/tools/linearizability/history.hpp"

#include <utility>

namespace castor::simulation {

namespace {

constexpr std::pair<std::string_view, std::string_view> known[] = {
  {"machines", "1"},
  {"machines", "2"},
  {"machines", "3"},
  {"faults", "crash"},
  {"faults", "hang"},
  {"faults", "kill"},
  {"faults", "stop"},
  {"faults", "partition"},
  {"faults", "delay"},
  {"faults", "drop"},
  {"faults", "jump clock"},
  {"faults", "slow journal"},
  {"faults", "fail journal"},
  {"calls", "made"},
  {"calls", "taken"},
  {"calls", "replied to"},
  {"calls", "not written"},
  {"calls", "not answered in time"},
  {"calls", "given up by its server"},
  {"journals", "opened"},
  {"journals", "opened again"},
  {"journals", "entry recovered"},
  {"journals", "change with an event found in the journal"},
  {"journals", "change with an event lost, within the bound"},
  {"tasks", "proposed"},
  {"tasks", "waiting"},
  {"tasks", "adopted"},
  {"tasks", "rejected"},
  {"tasks", "retracted"},
  {"tasks", "succeeded"},
  {"tasks", "not succeeded"},
  {"tasks", "abandoned"},
  {"outages", "component down"},
  {"outages", "component back"},
  {"outages", "working memory lost its entries"},
};

} // namespace

Happenings Happenings::everything() {
  Happenings result;
  for (auto& [group, what] : known)
    result.add(group, what, 0);
  using Kind = linearizability::OperationKind;
  for (auto kind : {Kind::add, Kind::overwrite, Kind::remove, Kind::read, Kind::exists,
                    Kind::version, Kind::lock, Kind::try_lock, Kind::unlock}) {
    result.add("operations", to_string(kind) + " ok", 0);
    result.add("operations", to_string(kind) + " not answered", 0);
  }
  return result;
}

void Happenings::add(std::string_view group, std::string_view what, std::uint64_t times) {
  auto i = groups_.find(group);
  if (i == groups_.end())
    i = groups_.emplace(group, Counts{}).first;
  auto j = i->second.find(what);
  if (j == i->second.end())
    i->second.emplace(what, times);
  else
    j->second += times;
}

void Happenings::add(const Happenings& other) {
  for (auto& [group, counts] : other.groups_)
    for (auto& [what, times] : counts)
      add(group, what, times);
}

std::uint64_t Happenings::count(std::string_view group, std::string_view what) const {
  auto i = groups_.find(group);
  if (i == groups_.end())
    return 0;
  auto j = i->second.find(what);
  return j == i->second.end() ? 0 : j->second;
}

std::uint64_t Happenings::sum(std::string_view group) const {
  std::uint64_t result = 0;
  if (auto i = groups_.find(group); i != groups_.end())
    for (auto& [what, times] : i->second)
      result += times;
  return result;
}

std::vector<std::string> Happenings::never() const {
  std::vector<std::string> result;
  for (auto& [group, counts] : groups_)
    for (auto& [what, times] : counts)
      if (times == 0)
        result.push_back(group + ": " + what);
  return result;
}

} // namespace castor::simulation
