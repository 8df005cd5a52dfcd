#include "castor/actors/system/run_loop.hpp"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <utility>
#include <variant>
#include <vector>

namespace castor {

namespace {

using namespace std::chrono_literals;

/// How often a running system is looked at.
constexpr std::chrono::milliseconds glance_interval = 50ms;

/// A component that was busy for longer than this when looked at keeps a system from being quiet;
/// one that merely polls does not.
constexpr auto polling = 200ms;

bool somebody_is_busy(const std::vector<ComponentStatus>& components) {
  return std::any_of(components.begin(), components.end(),
                     [](auto& x) { return x.busy > polling; });
}

/// Task managers alone do nothing.
bool all_failed(const std::vector<ComponentStatus>& components) {
  return std::all_of(components.begin(), components.end(), [](auto& x) {
    return x.is_task_manager ||
           (x.state == ComponentState::failed && !x.out_of_reach && !x.will_restart);
  });
}

} // namespace

bool RunLoop::start() {
  started_ = true;
  parts_.observation.update();
  auto problems = parts_.supervisor.start(names_of(parts_.architecture));
  if (!problems)
    return false;
  if (!problems->empty()) {
    was_refused_ = true;
    stop();
    throw SystemError{*std::move(problems)};
  }
  return true;
}

EndReason RunLoop::wait(const RunLimits& until) {
  auto begin = std::chrono::steady_clock::now();
  auto last_activity = begin;
  std::uint64_t last_events = 0;
  for (;;) {
    if (parts_.inbox.wait(glance_interval))
      return EndReason::ended_by_component;
    carry_out_orders();
    auto now = std::chrono::steady_clock::now();
    if (interrupted())
      return EndReason::interrupted;
    if (until.at_most && now - begin >= *until.at_most)
      return EndReason::time_over;
    auto components = parts_.status.components();
    if (all_failed(components))
      return EndReason::all_failed;
    if (!until.quiet)
      continue;
    auto events = parts_.status.sum_of(&WorkingMemoryStatus::events);
    if (std::exchange(last_events, events) != events || somebody_is_busy(components))
      last_activity = now;
    if (now - last_activity >= *until.quiet)
      return EndReason::quiet;
  }
}

void RunLoop::stop() {
  stopped_ = true;
  parts_.processes.suppress_notifications();
  refuse_orders();
  // With the working memories, whatever else is done to anybody is over.
  auto names = names_of(parts_.architecture);
  if (was_refused_)
    parts_.supervisor.stop(names);
  else if (started_)
    parts_.supervisor.stop_and_log(names);
  parts_.observation.flush();
}

void RunLoop::carry_out_orders() {
  for (auto& order : parts_.inbox.take_orders()) {
    if (auto* name = std::get_if<std::string>(&order.what))
      order.done({parts_.reconfiguration.remove(*name), {}});
    else
      order.done(
        {{}, parts_.reconfiguration.add(std::move(std::get<ArchitectureDescription>(order.what)))});
  }
}

void RunLoop::refuse_orders() {
  for (auto& order : parts_.inbox.take_orders())
    order.done({"the system is about to end", {}});
}

} // namespace castor
