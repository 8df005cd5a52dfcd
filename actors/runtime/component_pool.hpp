#pragma once

#include "castor/actors/runtime/pool_staff.hpp"
#include "castor/base/caf.hpp"
#include "castor/wm/clock/activity.hpp"

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>

namespace castor {

/// An actor that has no thread: a ComponentPool runs its turns.
class PoolMember {
public:
  virtual ~PoolMember() = default;

  /// Does what there is to do, without waiting. Called by one thread at a time.
  virtual void run_turn() = 0;

  virtual caf::strong_actor_ptr handle() = 0;
};

/// Runs the turns of actors on a few threads that they share, in the order in which they became
/// ready.
///
/// A member that computes for long holds up the thread that runs it, not the others: once a turn
/// has taken longer than `PoolStaff::Limits::patience` and others wait, another thread takes the
/// place of this one, which ends when the turn does. Only if as many members as there may be
/// threads compute at the same time, the others wait for one of these.
///
/// There are threads only while there are members, which keep the actor system alive. With a
/// simulated clock a member that is ready, or runs, holds a token of the process's activity. Safe
/// to use from any thread.
class ComponentPool : public std::enable_shared_from_this<ComponentPool> {
public:
  using Clock = std::chrono::steady_clock;

  /// As many threads as there are processors, and two at least.
  static PoolStaff::Limits standard_limits();

  /// `activity` is null if the clock is the real one.
  ComponentPool(caf::actor_system& system, std::shared_ptr<Activity> activity,
                PoolStaff::Limits limits = standard_limits());

  /// A member begins.
  void enter();
  /// It has ended; called in its last turn.
  void leave();

  /// Has a turn of the member run, which must have none that waits to be run.
  void schedule(PoolMember& x);

  /// Sends the member that message when it is `time`.
  void wake_at(Clock::time_point time, const caf::strong_actor_ptr& member, caf::message call);

private:
  struct Job {
    caf::strong_actor_ptr actor;
    PoolMember* member = nullptr;
    /// Of the token that it holds; 0 for none.
    Activity::Turn turn = 0;
  };

  struct Alarm {
    caf::weak_actor_ptr member;
    caf::message call;
  };

  using Lock = std::unique_lock<std::mutex>;

  // All but `run` are called under the mutex.

  /// Calls `f` on a new thread that the actor system waits for.
  void start_thread(std::function<void(ComponentPool&)> f);
  void hire(std::size_t count);
  /// Runs turns, on a thread for it.
  void work(PoolStaff::Id self);
  void run(Job job);
  /// Members wait for a thread: has that looked after until none does.
  void watch_queue();
  /// Has the watch look at that time at the latest.
  void watch_from(Clock::time_point time);
  /// Calls members at their times, and hires threads in the place of those that are held up; on a
  /// thread for it.
  void watch();
  /// Sends the calls that are due; false if none is.
  bool call_due(Lock& lock);

  caf::actor_system& system_;
  const std::shared_ptr<Activity> activity_;
  const PoolStaff::Limits limits_;

  std::mutex mutex_;
  std::condition_variable work_;
  std::condition_variable watch_;
  std::size_t members_ = 0;
  std::size_t idle_ = 0;
  PoolStaff staff_;
  std::deque<Job> queue_;
  std::multimap<Clock::time_point, Alarm> alarms_;
  bool is_watched_ = false;
  bool is_queue_watched_ = false;
  /// When the watch looks next.
  Clock::time_point next_look_ = Clock::time_point::max();
};

} // namespace castor
