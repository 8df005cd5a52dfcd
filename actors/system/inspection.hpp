#pragma once

#include "castor/actors/system/inspection_protocol.hpp"

#include <caf/event_based_actor.hpp>

namespace castor {

/// Answers one request of one connection. A request without an end (`events`) is answered until the
/// actor is ended. Later requests control a replay (pause, go on, end).
caf::behavior inspection(caf::event_based_actor* self, InspectionParts parts);

} // namespace castor
