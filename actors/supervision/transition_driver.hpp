#pragma once

#include "castor/actors/node/part_protocol.hpp"
#include "castor/actors/runtime/shell_protocol.hpp"
#include "castor/wm/clock/activity.hpp"
#include "castor/wm/values/timestamp.hpp"

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace castor {

/// Turn of a transition that is to be looked at again.
struct TransitionReminder {
  std::uint64_t transition = 0;
  std::uint64_t turn = 0;
  /// Simulated time stands as long as the reminder is under way; may be null.
  std::shared_ptr<TimeHold> hold = nullptr;
};

/// Executes the commands of a TransitionScheduler, and answers its questions.
class TransitionDriver {
public:
  using TimePoint = std::chrono::steady_clock::time_point;

  virtual ~TransitionDriver() = default;

  virtual TimePoint now() const = 0;
  /// Whether children are to have less time to stop, because the user has interrupted the system.
  virtual bool is_interrupted() const = 0;
  /// Whether the child's process can be reached.
  virtual bool is_reachable(const std::string& child) const = 0;
  virtual bool has_actor(const std::string& child) const = 0;
  /// Whether the child's actor, which it has, is another one than the last phase command was sent
  /// to.
  virtual bool is_replaced(const std::string& child) const = 0;

  /// To be followed by `TransitionScheduler::remind`.
  virtual void remind(const TransitionReminder& of, Timestamp after) = 0;
  /// The same; simulated time stands until then.
  virtual void delay(const TransitionReminder& of, Timestamp by) { remind(of, by); }
  /// To be followed by `TransitionScheduler::ended`, if the child returns from its own code.
  virtual void stop(const std::string& child) = 0;
  /// Kills the process of a child that does not stop; then `ended` or `lose` follow. False if the
  /// child has no process of its own, or that has ended already.
  virtual bool kill(const std::string& child) = 0;
  /// Makes these anew, in the incarnations of the model. `by_plan` if all processes have to know of
  /// it. Calls `done` later, with those that could not be made.
  virtual void make(const std::vector<std::string>& children, bool by_plan,
                    std::function<void(const std::set<std::string>& failed)> done) = 0;
  /// The child has an actor. To be followed by `TransitionScheduler::phase_done`, unless the phase
  /// is Phase::run.
  virtual void enter(const std::string& child, Phase phase) = 0;
};

/// Observer of the effects of transitions.
class TransitionObserver {
public:
  virtual ~TransitionObserver() = default;

  /// The child is down, and is to be started again.
  virtual void on_down(const std::string& child, const std::string& reason) = 0;
  virtual void on_up(const std::string& child) = 0;
  /// The child did not stop, and is given up. `restarts` if it was to be started again.
  virtual void on_stuck(const std::string& child, bool restarts) = 0;
  /// The child takes long in a phase.
  virtual void on_slow(const std::string& child, Phase phase) = 0;
  /// A transition has ended.
  virtual void on_change() = 0;
  /// The child failed during a transition that has ended now. May begin another one.
  virtual void on_failure(const ComponentEnded& x) = 0;
};

} // namespace castor
