#pragma once

#include "castor/wm/clock/activity.hpp"
#include "castor/wm/clock/clock_messages.hpp"
#include "castor/wm/clock/sleepers.hpp"
#include "castor/wm/values/timestamp.hpp"

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>

namespace castor {

/// Whom the clock of a process reports to: that of the system.
class ClockAuthority {
public:
  virtual ~ClockAuthority() = default;

  /// Messages that were exchanged with other processes so far.
  virtual MessageCounts counts() const = 0;
  /// Returns how time goes on, if that is decided at once. Called by one thread at a time; must not
  /// call the clock.
  virtual std::optional<ClockAdvance> report(ClockReport x) = 0;
};

/// The simulated clock of a system, in one of its processes. Where there is none, the clock is the
/// real one.
///
/// Time stands while somebody holds a token of the process's `Activity`. When nobody does, those
/// who are due are woken, and if there are none, the clock reports to its authority, which decides
/// when time goes on. Safe to use from any thread.
class SimulatedClock final : public QuietListener,
                             public std::enable_shared_from_this<SimulatedClock> {
public:
  using Wake = Sleepers::Wake;
  using Key = Sleepers::Key;

  SimulatedClock(std::shared_ptr<Activity> activity, ClockAdvance present)
    : activity_(std::move(activity)), round_(present.round), now_(present.time.count()) {}

  /// Reports to `x` from now on, which has to live until the clock reports to another one, or to
  /// null.
  void report_to(ClockAuthority* x);

  Timestamp now() const { return Timestamp{now_.load(std::memory_order_acquire)}; }

  Activity& activity() { return *activity_; }
  const std::shared_ptr<Activity>& shared_activity() const { return activity_; }

  /// Keeps time from going on as long as the result lives.
  TimeHold hold() const { return TimeHold{activity_}; }

  /// Calls `wake` once, on any thread, when it is `time`; of several at one time in the order of
  /// `order`. To be called by the holder of a token. `wake` activates somebody.
  Key wake_at(Timestamp time, std::uint64_t order, Wake wake);
  /// Nobody need be woken any more; nothing happens if that has been done.
  void forget(const Key& key);

  /// Time goes on; nothing happens if it was known already.
  void advance(const ClockAdvance& x);

  /// Round and time, to be sent with every message to another process.
  ClockAdvance present() const;

  void on_quiet() override;

private:
  std::vector<Wake> take_due();
  void set(const ClockAdvance& x);

  const std::shared_ptr<Activity> activity_;
  mutable std::mutex mutex_;
  ClockAuthority* authority_ = nullptr;
  Sleepers sleepers_;
  std::uint64_t round_;
  std::atomic<std::int64_t> now_;
};

} // namespace castor
