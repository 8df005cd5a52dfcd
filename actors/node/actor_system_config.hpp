#pragma once

#include "castor/actors/node/counting_config.hpp"

#include <memory>

namespace castor {

/// Configuration of the actor system of a process.
class ActorSystemConfig : public CountingConfig {
public:
  /// With the network's thread, or without. Actors of the pool hold tokens of `activity` while they
  /// are ready or run, if it is not null.
  explicit ActorSystemConfig(bool networked, std::shared_ptr<Activity> activity = nullptr);
};

} // namespace castor
