#pragma once

#include "castor/actors/system/inspection_context.hpp"

namespace castor {

/// Answers the request `clock` (docs/introspection.md): shows the clock of the system, or changes
/// the pace of simulated time. Throws for invalid requests.
void show_or_set_clock(const InspectionContextPtr& context, const Json& request);

} // namespace castor
