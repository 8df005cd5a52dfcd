#include "castor/actors/system/component_statuses.hpp"

#include <map>
#include <string>

namespace castor {

namespace {

/// Of a component whose node does not answer.
ComponentStatus status_of_absent(ComponentStatus known, const SystemRoster& roster,
                                 const PartStatuses& parts) {
  auto process = process_of(roster.placement, known.identity.name);
  auto* link = find_link(parts, 0, process);
  known.state = ComponentState::failed;
  known.out_of_reach = !link || link->news.state != LinkState::lost;
  known.failure =
    "its node " +
    (process < roster.processes.size() ? roster.processes[process].name : std::string{}) +
    " does not answer";
  if (link && link->news.state != LinkState::up)
    known.failure += ": " + link->news.reason;
  return known;
}

} // namespace

const LinkStatus* find_link(const PartStatuses& parts, ProcessNumber from, ProcessNumber to) {
  if (from >= parts.size() || !parts[from])
    return nullptr;
  for (auto& x : parts[from]->links)
    if (x.news.peer == to)
      return &x;
  return nullptr;
}

std::vector<ComponentStatus> component_statuses(const SystemRoster& roster,
                                                const PartStatuses& parts) {
  std::map<std::string, const ComponentStatus*> found;
  for (auto& part : parts)
    if (part)
      for (auto& x : part->components)
        found[x.identity.name] = &x;
  std::vector<ComponentStatus> result;
  for (auto& known : roster.components) {
    auto i = found.find(known.identity.name);
    if (i == found.end()) {
      result.push_back(status_of_absent(known, roster, parts));
      continue;
    }
    result.push_back(*i->second);
    result.back().restarts = known.restarts;
    result.back().will_restart =
      known.will_restart && result.back().state == ComponentState::failed;
  }
  return result;
}

} // namespace castor
