#pragma once

#include "castor/actors/cast/description.hpp"
#include "castor/actors/node/system_options.hpp"
#include "castor/actors/system/roster_feed.hpp"
#include "castor/actors/system/status_collector.hpp"

#include <caf/scoped_actor.hpp>

namespace castor {

/// Observation of a system: spawns an observer if the options or the architecture ask for one, and
/// waits until it has reported all changes.
class Observation {
public:
  /// All of them have to outlive it.
  Observation(caf::actor_system& system, const SystemOptions& options,
              const ArchitectureDescription& architecture, RosterFeed& roster,
              StatusCollector& status);

  /// Receiver of every TaskEvent, or null.
  caf::actor task_observer() const { return options_.on_task ? observer_ : nullptr; }

  /// Adapts the observer to the present architecture. When this returns, its subscriptions are in
  /// force.
  void update();

  /// Waits until all changes so far have been reported.
  void catch_up();

  /// Waits until nothing is left to report, including events that working memories send only once
  /// earlier ones were taken.
  void flush();

  void end();

private:
  void make_observer();
  void await_observer();

  caf::actor_system& system_;
  caf::scoped_actor self_{system_};
  const SystemOptions& options_;
  const ArchitectureDescription& architecture_;
  RosterFeed& roster_;
  StatusCollector& status_;
  caf::actor observer_;
};

} // namespace castor
