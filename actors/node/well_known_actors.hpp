#pragma once

#include "castor/actors/link/actor_name.hpp"

namespace castor {

/// Answers for the process's part of the system.
inline constexpr WellKnownActor part_agent_number{1};
/// Hands events to the process's working memories.
inline constexpr WellKnownActor event_sink_number{2};

} // namespace castor
