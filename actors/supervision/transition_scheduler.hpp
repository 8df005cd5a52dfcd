#pragma once

#include "castor/actors/supervision/failover.hpp"
#include "castor/actors/supervision/system_model.hpp"
#include "castor/actors/supervision/transition.hpp"
#include "castor/actors/supervision/transition_driver.hpp"

#include <cstdint>
#include <list>
#include <set>
#include <string>
#include <vector>

namespace castor {

/// Stops and starts the children of a system. Transitions that share children run one after the
/// other, others at the same time; one that involves all children of another one replaces it.
///
/// Pure but for the driver and the observer.
class TransitionScheduler {
public:
  /// All of them have to outlive it.
  TransitionScheduler(SystemModel& model, Failover& failover, TransitionDriver& driver,
                      TransitionObserver& observer)
    : model_(model), failover_(failover), driver_(driver), observer_(observer) {}

  void begin(TransitionRequest request);

  /// Begins a transition that stops children for good: other transitions do not start them any
  /// more, nor wait for those that block in configure() or start().
  void stop(TransitionRequest request);

  // -- what has happened

  void remind(const TransitionReminder& x);
  void phase_done(const PhaseDone& x);
  /// A child has ended in its present life, which is known to the model; it `was_alive` before.
  /// True if a running transition takes care of that.
  bool ended(const ComponentEnded& x, bool was_alive);
  /// A process is lost. These ran in it and are to continue in another one; the model is up to date
  /// for all that ran in it.
  void lose(const std::vector<std::string>& children);
  /// Continues transitions that waited for an actor that may be known now, or was replaced.
  void resume();

  // -- what is under way

  /// Whether a transition that involves the child runs or waits.
  bool is_scheduled(const std::string& child) const;
  const std::list<Transition>& running() const { return running_; }
  const std::list<Transition>& waiting() const { return waiting_; }

private:
  using Iterator = std::list<Transition>::iterator;

  Iterator find(std::uint64_t id);
  Iterator running_with(const std::string& child);
  bool must_wait(const Transition& x) const;
  void begin_waiting();
  void advance(Iterator i);
  void end(Iterator i);

  /// Stops one child after the other; true when the last one has stopped.
  bool stop_next(Transition& x);
  bool kill_to_stop(Transition& x, const std::string& child);
  void make(Transition& x);
  /// The children of the transition were made, except those that `failed`.
  void made(std::uint64_t transition, const std::set<std::string>& failed);
  void enter_configure(Transition& x);
  /// Takes one child after the other through a phase; true when the last one is done.
  bool enter_next(Transition& x, Phase phase);
  /// Whether it is alive and goes through phases.
  bool takes_part(const std::string& child) const;
  Diagnostic wrong_configuration(const std::string& child, const std::string& what) const;
  void remind_later(const Transition& x, Timestamp delay);

  SystemModel& model_;
  Failover& failover_;
  TransitionDriver& driver_;
  TransitionObserver& observer_;
  std::list<Transition> running_;
  /// Those that share children with running ones, in the order of their requests.
  std::list<Transition> waiting_;
  std::uint64_t last_id_ = 0;
};

} // namespace castor
