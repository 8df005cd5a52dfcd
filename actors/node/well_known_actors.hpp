#pragma once

#include "castor/actors/link/actor_name.hpp"

namespace castor {

/// Agent of the process's part of the system (part_agent.hpp).
inline constexpr WellKnownActor part_agent_number{1};
/// Receiver of change events for the process's working memories.
inline constexpr WellKnownActor event_sink_number{2};

} // namespace castor
