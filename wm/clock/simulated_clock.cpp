#include "castor/wm/clock/simulated_clock.hpp"

#include <limits>
#include <utility>
#include <vector>

namespace castor {

void SimulatedClock::report_to(ClockAuthority* x) {
  {
    std::lock_guard guard{mutex_};
    authority_ = x;
  }
  if (x)
    activity_->add_listener(shared_from_this());
}

SimulatedClock::Key SimulatedClock::wake_at(Timestamp time, std::uint64_t order, Wake wake) {
  std::lock_guard guard{mutex_};
  return sleepers_.add(time, order, std::move(wake));
}

void SimulatedClock::forget(const Key& key) {
  std::lock_guard guard{mutex_};
  sleepers_.remove(key);
}

ClockAdvance SimulatedClock::present() const {
  std::lock_guard guard{mutex_};
  return {round_, now()};
}

void SimulatedClock::set(const ClockAdvance& x) {
  round_ = x.round;
  now_.store(x.time.count(), std::memory_order_release);
}

std::vector<SimulatedClock::Wake> SimulatedClock::take_due() {
  auto count = activity_->is_one_at_a_time() ? 1 : std::numeric_limits<std::size_t>::max();
  return sleepers_.take_due(now(), count);
}

void SimulatedClock::advance(const ClockAdvance& x) {
  activity_->hold();
  std::vector<Wake> due;
  {
    std::lock_guard guard{mutex_};
    if (x.round > round_) {
      set(x);
      due = take_due();
    }
  }
  for (auto& wake : due)
    wake();
  activity_->release();
}

void SimulatedClock::on_quiet() {
  std::unique_lock guard{mutex_};
  while (authority_ && activity_->hold_if_quiet()) {
    auto activations = activity_->activations();
    bool has_reported = false;
    auto due = take_due();
    if (due.empty()) {
      auto counts = authority_->counts();
      // A message that arrived meanwhile is counted, but has activated somebody: that is no report.
      if (activity_->activations() == activations) {
        auto advance = authority_->report({round_, sleepers_.next(), std::move(counts)});
        has_reported = !advance;
        if (advance) {
          set(*advance);
          due = take_due();
        }
      }
    }
    guard.unlock();
    for (auto& wake : due)
      wake();
    guard.lock();
    // Whoever holds another token calls this again.
    if (!activity_->release_silently())
      return;
    // Somebody from outside may have come and gone, and sleep now.
    if (has_reported && activity_->activations() == activations)
      return;
  }
}

} // namespace castor
