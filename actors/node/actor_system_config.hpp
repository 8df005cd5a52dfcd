#pragma once

#include <caf/actor_system_config.hpp>

namespace castor {

/// How the actor system of a process is set up.
class ActorSystemConfig : public caf::actor_system_config {
public:
  /// With the network's thread, or without.
  explicit ActorSystemConfig(bool networked);
};

} // namespace castor
