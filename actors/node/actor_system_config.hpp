#pragma once

#include "castor/wm/clock/activity.hpp"

#include <caf/actor_system_config.hpp>
#include <caf/fwd.hpp>

#include <memory>

namespace castor {

/// Configuration of the actor system of a process.
class ActorSystemConfig : public caf::actor_system_config {
public:
  /// With the network's thread, or without. Actors of the pool hold tokens of `activity` while they
  /// are ready or run, if it is not null.
  explicit ActorSystemConfig(bool networked, std::shared_ptr<Activity> activity = nullptr);

  const std::shared_ptr<Activity>& activity() const { return activity_; }

private:
  const std::shared_ptr<Activity> activity_;
};

/// The activity of the actor system's process; null if it is not counted.
std::shared_ptr<Activity> activity_of(const caf::actor_system& system);

} // namespace castor
