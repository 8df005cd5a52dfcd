#pragma once

#include "castor/actors/system/inspection_context.hpp"

namespace castor {

class ClockControl;

/// The clock of the system as requests show it (docs/introspection.md).
/// @param clock null for the real clock
Json clock_report(const ClockControl* clock);

/// Answers the request `clock` (docs/introspection.md): shows the clock of the system, or changes
/// the pace of simulated time. Throws for invalid requests.
void show_or_set_clock(const InspectionContextPtr& context, const Json& request);

} // namespace castor
