#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <vector>

namespace castor {

/// Wakes the one thread that waits at it.
///
/// Lighter than a condition variable: who rings holds no mutex that the woken thread would have to
/// wait for, and deadlines are those of the steady clock.
class Doorbell {
public:
  using Clock = std::chrono::steady_clock;

  /// Wakes the thread if it waits; in a RingBatch, at its end at the latest.
  static void ring(const std::shared_ptr<Doorbell>& bell);

  /// Waits while `is_idle()`; false once `until` has passed. Who makes that false rings afterwards.
  template <class F>
  bool wait_while(F&& is_idle, Clock::time_point until) {
    bool is_in_time = true;
    do {
      // First: of a ring from here on, either the state or the count tells.
      auto seen = rings_.load();
      ring_all(state_.exchange(waiting()));
      if (!is_idle())
        break;
      is_in_time = sleep(seen, until);
    } while (is_in_time);
    ring_all(state_.exchange(nullptr));
    return is_in_time;
  }

private:
  friend class RingBatch;

  /// Doorbells to ring one after the other.
  struct Chain {
    std::shared_ptr<Doorbell> bell;
    Chain* next = nullptr;
  };

  /// States besides null, nobody waits, and what is to be rung by the thread that was woken.
  static Chain* waiting();
  static Chain* woken();

  /// Rings the first at which somebody waits, who is to ring the others. Takes the chain over.
  static void ring_all(Chain* chain);

  /// False if nobody waits here; else takes `others` over, for the woken thread to ring.
  bool wake(Chain* others);
  /// Returns after a ring since `seen`, or without reason; false once `until` has passed.
  bool sleep(std::uint32_t seen, Clock::time_point until);

  std::atomic<Chain*> state_{nullptr};
  std::atomic<std::uint32_t> rings_{0};
};

/// While it exists, doorbells that its thread rings are collected. At its end as many are rung as
/// there are processors; each woken thread rings the next before it does anything else. So a thread
/// that wakes many others can go on, and what it has for them meanwhile costs no further waking.
/// One inside another does nothing.
class RingBatch {
public:
  RingBatch();
  RingBatch(const RingBatch&) = delete;
  RingBatch& operator=(const RingBatch&) = delete;
  ~RingBatch();

private:
  friend class Doorbell;

  const bool is_outermost_;
  std::vector<std::shared_ptr<Doorbell>> bells_;
};

} // namespace castor
