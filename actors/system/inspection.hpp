#pragma once

#include "castor/actors/system/inspection_protocol.hpp"

#include <caf/event_based_actor.hpp>

namespace castor {

/// Answers one request for one connection, which may take for ever (`events`): it then goes on
/// until it is ended. Later requests control a replay (pause, go on, end).
caf::behavior inspection(caf::event_based_actor* self, InspectionParts parts);

} // namespace castor
