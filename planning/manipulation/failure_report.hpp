#pragma once

#include "castor/planning/manipulation/blocked_way.hpp"
#include "castor/planning/manipulation/seen_table.hpp"
#include "castor/planning/manipulation/types.hpp"

#include <vector>

namespace castor::manipulation {

/// Says why there is no motion: the reason, with the joints that do not move any more, and what is
/// in the way.
/// @param told has those joints
/// @param things that are seen
void tell_failure(Manipulation& told, const MotionFailure& failure,
                  const std::vector<SeenThing>& things);

} // namespace castor::manipulation
