#include "castor/actors/system/run_loop.hpp"

#include "castor/base/at_exit.hpp"
#include "castor/base/log.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace castor {

namespace {

using namespace std::chrono_literals;

/// How often a running system is looked at.
constexpr std::chrono::milliseconds glance_interval = 50ms;

/// How long simulated time may stand before that is reported.
constexpr auto standing_time = 3s;

using CpuTimes = std::map<std::string, std::chrono::nanoseconds>;

CpuTimes cpu_of(const std::vector<ComponentStatus>& components) {
  CpuTimes result;
  for (auto& x : components)
    result[x.identity.full_name()] = x.cpu;
  return result;
}

/// Components that keep simulated time from going on: those that do not wait, and those that work
/// as often as they are woken, such as two that answer each other's changes.
std::string names_of_working(const std::vector<ComponentStatus>& components, const CpuTimes& then) {
  std::string result;
  for (auto& x : components) {
    auto name = x.identity.full_name();
    auto i = then.find(name);
    // Task managers only work because of the others.
    auto has_worked =
      !x.is_task_manager && i != then.end() && x.cpu - i->second > standing_time / 10;
    if (has_work(x) || has_worked)
      result += (result.empty() ? "" : ", ") + name;
  }
  return result;
}

/// Whether components have failed, been started again, come or gone since `then`.
bool have_states_changed(const std::vector<ComponentStatus>& then,
                         const std::vector<ComponentStatus>& now) {
  return !std::ranges::equal(then, now, [](auto& x, auto& y) {
    return x.identity.name == y.identity.name && x.state == y.state && x.restarts == y.restarts;
  });
}

/// Task managers alone do nothing.
bool all_failed(const std::vector<ComponentStatus>& components) {
  return std::ranges::all_of(components, [](auto& x) {
    return x.is_task_manager ||
           (x.state == ComponentState::failed && !x.out_of_reach && !x.will_restart);
  });
}

} // namespace

bool RunLoop::start() {
  started_ = true;
  parts_.observation.update();
  auto* clock = parts_.clock;
  if (clock)
    clock->set_limit(Timestamp::max());
  // Simulated time stands again before anybody runs for longer than `wait` allows.
  auto problems = parts_.supervisor.start(names_of(parts_.architecture), [clock] {
    if (clock)
      clock->stand();
  });
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
  return parts_.clock ? wait_for_simulated_time(until) : wait_for_real_time(until);
}

std::optional<EndReason> RunLoop::look(bool asks_all) {
  if (parts_.inbox.wait(glance_interval))
    return EndReason::ended_by_component;
  carry_out_orders();
  if (interrupted())
    return EndReason::interrupted;
  looked_at_ = std::chrono::steady_clock::now();
  if (!asks_all && !parts_.status.is_nobody_left())
    return std::nullopt;
  components_ = parts_.status.components();
  if (all_failed(components_))
    return EndReason::all_failed;
  return std::nullopt;
}

EndReason RunLoop::wait_for_real_time(const RunLimits& until) {
  auto begin = std::chrono::steady_clock::now();
  auto last_activity = begin;
  std::uint64_t last_events = 0;
  for (;;) {
    const auto before = components_;
    if (auto reason = look(until.quiet.has_value()))
      return *reason;
    const auto now = looked_at_;
    if (until.at_most && now - begin >= *until.at_most)
      return EndReason::time_over;
    if (!until.quiet)
      continue;
    auto events = parts_.status.sum_of(&WorkingMemoryStatus::events);
    if (std::exchange(last_events, events) != events || have_states_changed(before, components_) ||
        std::ranges::any_of(components_, has_work))
      last_activity = now;
    const auto quiet = last_activity + *until.quiet;
    // Who has been busy since then may be about to change something; this thread may look late.
    auto is_in_the_middle = [&](auto& x) { return x.busy > 0ns && now - x.busy < quiet; };
    if (now >= quiet && std::ranges::none_of(components_, is_in_the_middle))
      return EndReason::quiet;
  }
}

EndReason RunLoop::wait_for_simulated_time(const RunLimits& until) {
  auto& clock = *parts_.clock;
  auto after = [](Timestamp x, std::chrono::nanoseconds duration) {
    // In microseconds, since the maximum has too many nanoseconds.
    auto microseconds = std::chrono::ceil<Timestamp>(duration);
    return microseconds < Timestamp::max() - x ? x + microseconds : Timestamp::max();
  };
  auto now = [&] { return clock.clock()->now(); };
  const auto begin = now();
  const auto end = until.at_most ? after(begin, *until.at_most) : Timestamp::max();
  const AtExit stand{[&] { clock.stand(); }};
  const auto real_begin = std::chrono::steady_clock::now();
  seen_since_ = real_begin;
  cpu_then_.clear();
  for (;;) {
    auto quiet = Timestamp::max();
    if (until.quiet) {
      auto last_event = begin;
      for (auto& x : parts_.status.working_memories())
        last_event = std::max(last_event, x.last_event);
      quiet = after(last_event, *until.quiet);
    }
    if (now() >= end)
      return EndReason::time_over;
    if (now() >= quiet)
      return EndReason::quiet;
    const auto limit = std::min(end, quiet);
    parts_.inbox.await_limit(limit);
    clock.set_limit(limit);
    while (!parts_.inbox.is_at_limit()) {
      if (auto reason = look(true))
        return *reason;
      if (until.at_most_real &&
          std::chrono::steady_clock::now() - real_begin >= *until.at_most_real)
        return EndReason::time_over;
      report_standing_time();
    }
  }
}

void RunLoop::report_standing_time() {
  auto& clock = *parts_.clock;
  auto real = std::chrono::steady_clock::now();
  auto time = clock.clock()->now();
  auto pace = clock.pace();
  const bool goes_on =
    std::exchange(seen_time_, time) != time || pace.paused || clock.busy().empty();
  if (goes_on)
    seen_since_ = real;
  if (goes_on || cpu_then_.empty())
    cpu_then_ = cpu_of(components_);
  if (real - seen_since_ < standing_time)
    return;
  auto names = names_of_working(components_, cpu_then_);
  seen_since_ = real;
  cpu_then_ = cpu_of(components_);
  if (!names.empty())
    log_runtime(LogLevel::warning,
                fmt::format("simulated time stands at {:.3f} s, while these work without a pause: "
                            "{}; it goes on when all components wait, with sleep_for, "
                            "wait_for_changes or an operation",
                            std::chrono::duration<double>{time}.count(), names));
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
