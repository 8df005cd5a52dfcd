#pragma once

#include "castor/planning/symbolic/ground_task.hpp"
#include "castor/planning/symbolic/task.hpp"

namespace castor::planning {

/// Groups of atoms of which exactly or at most one is true in every reachable state, by invariants
/// of the form "the number of true atoms of these predicates with these parameters never grows"
/// (Helmert 2009, section 5).
MutexGroups find_mutex_groups(const LiftedTask& lifted, const NormalTask& normal,
                              const GroundTask& ground, LimitWatch& watch);

} // namespace castor::planning
