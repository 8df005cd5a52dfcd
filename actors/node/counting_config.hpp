#pragma once

#include "castor/wm/clock/activity.hpp"

#include <caf/actor_system.hpp>
#include <caf/actor_system_config.hpp>

#include <memory>
#include <utility>

namespace castor {

/// Configuration of an actor system whose actors may be counted.
class CountingConfig : public caf::actor_system_config {
public:
  /// Null if actors are not counted.
  const std::shared_ptr<Activity>& activity() const { return activity_; }

protected:
  explicit CountingConfig(std::shared_ptr<Activity> activity) : activity_(std::move(activity)) {}

private:
  const std::shared_ptr<Activity> activity_;
};

/// The activity of the actor system's process; null if it is not counted.
inline std::shared_ptr<Activity> activity_of(const caf::actor_system& system) {
  auto* config = dynamic_cast<const CountingConfig*>(&system.config());
  return config ? config->activity() : nullptr;
}

} // namespace castor
