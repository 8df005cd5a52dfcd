#pragma once

#include "castor/benchmarks/manipulation/random_table.hpp"
#include "castor/planning/manipulation/manipulation_planner.hpp"

namespace castor::manipulation {

/// On the table, at most 1 cm from that spot of the table's frame, for the arm of the benchmarks.
PlaceGoal goal_at(const Spot& spot);

} // namespace castor::manipulation
