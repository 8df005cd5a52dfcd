#include "castor/actors/runtime/status.hpp"

namespace castor {

namespace {

/// One that is busy for no longer than this merely polls.
constexpr std::chrono::milliseconds polling{200};

} // namespace

bool has_work(const ComponentStatus& x) {
  return x.busy > polling || (x.state == ComponentState::started && !x.out_of_reach);
}

std::string state_of(const ComponentStatus& x) {
  if (x.will_restart)
    return "restarting";
  for (auto& [name, state] : reflection_of<ComponentState>().enumerators)
    if (state == x.state)
      return std::string{name};
  return {};
}

ComponentStatus status_of(const ComponentRecord& x, ComponentRecord::Clock::time_point now) {
  ComponentStatus result;
  result.identity = x.identity();
  result.state = x.state();
  result.failure = x.failure();
  result.busy = x.busy_for(now);
  result.cpu = x.cpu();
  result.events_received = x.counters.events_received;
  result.events_rejected = x.counters.events_rejected;
  result.callbacks = x.counters.callbacks;
  result.reads = x.counters.reads;
  result.writes = x.counters.adds + x.counters.overwrites + x.counters.deletes;
  result.pushes_dropped = x.counters.pushes_dropped;
  result.obeys = x.obeyed();
  return result;
}

} // namespace castor
