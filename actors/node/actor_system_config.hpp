#pragma once

#include <caf/actor_system_config.hpp>

namespace castor {

/// Configuration of the actor system of a process.
class ActorSystemConfig : public caf::actor_system_config {
public:
  /// With the network's thread, or without.
  explicit ActorSystemConfig(bool networked);
};

} // namespace castor
