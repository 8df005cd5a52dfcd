#pragma once

#include "castor/actors/cast/description.hpp"
#include "castor/actors/node/system_options.hpp"
#include "castor/actors/system/roster_feed.hpp"
#include "castor/actors/system/status_collector.hpp"

#include <caf/scoped_actor.hpp>

namespace castor {

/// Whether somebody observes a system: spawns an observer if the options or the architecture ask
/// for one, and waits until it has told what there is to tell.
class Observation {
public:
  /// All of them have to outlive it.
  Observation(caf::actor_system& system, const SystemOptions& options,
              const ArchitectureDescription& architecture, RosterFeed& roster,
              StatusCollector& status);

  /// Is to be sent every TaskEvent; null if nobody wants to know.
  caf::actor task_observer() const { return options_.on_task ? observer_ : nullptr; }

  /// Observes what the architecture has now; its subscriptions are in force then.
  void update();

  /// Waits until everything that has changed by now has been told.
  void catch_up();

  /// Waits until there is nothing left to tell: neither what it was sent, nor what it is sent when
  /// it has told that.
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
