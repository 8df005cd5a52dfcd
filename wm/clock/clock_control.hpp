#pragma once

#include "castor/wm/clock/simulated_clock.hpp"
#include "castor/wm/clock/time_control.hpp"

#include <chrono>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <vector>

namespace castor {

/// The simulated time of a system, in the process that decides about it: takes the reports of all
/// clocks, and lets time go on at a pace. Safe to use from any thread. Time stands at first.
class ClockControl final : public ClockAuthority {
public:
  struct Parts {
    /// The clock of this process.
    std::shared_ptr<SimulatedClock> clock;
    /// Sends to the clock of another process; null in a system of one process.
    std::function<void(ClockMember, const ClockAdvance&)> send;
    /// Messages exchanged with the other processes; null in a system of one process.
    std::function<MessageCounts()> counts;
    /// Called with the limit when time stands at it with nobody doing anything; must not call this
    /// object.
    std::function<void(Timestamp)> at_limit;
  };

  explicit ClockControl(Parts parts);
  ~ClockControl() override { close(); }

  /// Lets time stand for good: calls none of the parts any more.
  void close();

  const std::shared_ptr<SimulatedClock>& clock() const { return parts_.clock; }

  MessageCounts counts() const override;
  std::optional<ClockAdvance> report(ClockReport x) override;

  /// A report of another process.
  void receive(ClockMember from, ClockReport x);
  void add_member(ClockMember x);
  void remove_member(ClockMember x);

  /// Time goes on up to here.
  void set_limit(Timestamp x);
  /// Time stands from now on, until it gets another limit.
  void stand();
  void set_pace(const Pace& x);
  Pace pace() const;
  /// Lets that much time pass while it is paused.
  void step(Timestamp x);

  /// Processes in which somebody has something to do, if time stands because of that.
  std::vector<ClockMember> busy() const;

private:
  /// Changes something, and decides anew once the own process is quiet: since its last report,
  /// somebody from outside may have activated somebody.
  template <class F>
  void change(F&& f);
  std::optional<ClockAdvance> decide();
  /// Decides when it is time to.
  void keep_pace();

  const Parts parts_;
  mutable std::mutex mutex_;
  TimeControl control_{std::chrono::steady_clock::now()};
  /// When `pacer_` is to decide again; at no time if there is no value.
  std::optional<std::chrono::steady_clock::time_point> ask_again_;
  bool over_ = false;
  std::condition_variable changed_;
  /// Runs once there is a pace of real time.
  std::thread pacer_;
};

} // namespace castor
