#pragma once

#include "castor/planning/symbolic/ground_task.hpp"
#include "castor/planning/symbolic/task.hpp"

namespace castor::planning {

/// Groups of atoms of which at most one is true in every reachable state. Candidates are, as those
/// of Helmert (2009, section 5), predicates whose arguments are parameters but for at most one, and
/// are extended by predicates that balance the actions that they fail for. They are verified
/// without variables, group by group, so that a candidate need not hold for all values of its
/// parameters.
MutexGroups find_mutex_groups(const GroundTask& task, LimitWatch& watch);

} // namespace castor::planning
