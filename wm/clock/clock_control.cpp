#include "castor/wm/clock/clock_control.hpp"

#include <utility>

namespace castor {

using Clock = std::chrono::steady_clock;

ClockControl::ClockControl(Parts parts) : parts_(std::move(parts)) {
  control_.set_limit(Timestamp{0});
  parts_.clock->report_to(this);
}

void ClockControl::close() {
  parts_.clock->report_to(nullptr);
  {
    std::lock_guard guard{mutex_};
    over_ = true;
  }
  changed_.notify_all();
  if (pacer_.joinable())
    pacer_.join();
}

MessageCounts ClockControl::counts() const {
  return parts_.counts ? parts_.counts() : MessageCounts{};
}

std::optional<ClockAdvance> ClockControl::report(ClockReport x) {
  std::lock_guard guard{mutex_};
  control_.report(0, std::move(x));
  return decide();
}

void ClockControl::receive(ClockMember from, ClockReport x) {
  std::optional<ClockAdvance> advance;
  {
    std::lock_guard guard{mutex_};
    control_.report(from, std::move(x));
    advance = decide();
  }
  if (advance)
    parts_.clock->advance(*advance);
}

void ClockControl::add_member(ClockMember x) {
  std::lock_guard guard{mutex_};
  control_.add_member(x);
}

void ClockControl::remove_member(ClockMember x) {
  change([&] { control_.remove_member(x); });
}

void ClockControl::set_limit(Timestamp x) {
  change([&] { control_.set_limit(x); });
}

void ClockControl::stand() {
  std::lock_guard guard{mutex_};
  control_.set_limit(control_.now());
}

void ClockControl::set_pace(const Pace& x) {
  change([&] {
    control_.set_pace(x, Clock::now());
    if (x.factor && !pacer_.joinable() && !over_)
      pacer_ = std::thread{[this] { keep_pace(); }};
  });
}

Pace ClockControl::pace() const {
  std::lock_guard guard{mutex_};
  return control_.pace();
}

void ClockControl::step(Timestamp x) {
  change([&] { control_.step(x); });
}

std::vector<ClockMember> ClockControl::busy() const {
  std::lock_guard guard{mutex_};
  return control_.busy();
}

template <class F>
void ClockControl::change(F&& f) {
  {
    std::lock_guard guard{mutex_};
    f();
    control_.forget_report(0);
  }
  parts_.clock->on_quiet();
}

std::optional<ClockAdvance> ClockControl::decide() {
  if (over_)
    return std::nullopt;
  auto decision = control_.decide(Clock::now());
  if (decision.advance && parts_.send)
    for (auto x : decision.receivers)
      parts_.send(x, *decision.advance);
  ask_again_ = decision.ask_again;
  if (ask_again_)
    changed_.notify_all();
  if (decision.at_limit && parts_.at_limit)
    parts_.at_limit(control_.limit());
  return decision.advance;
}

void ClockControl::keep_pace() {
  std::unique_lock guard{mutex_};
  while (!over_) {
    if (!ask_again_) {
      changed_.wait(guard);
      continue;
    }
    if (Clock::now() < *ask_again_) {
      changed_.wait_until(guard, *ask_again_);
      continue;
    }
    ask_again_.reset();
    guard.unlock();
    change([] {});
    guard.lock();
  }
}

} // namespace castor
