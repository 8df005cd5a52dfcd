#pragma once

#include "castor/planning/continual/types.hpp"
#include "castor/planning/symbolic/planner.hpp"

#include <string>

namespace castor::planning {

/// A domain's text, and the file that it is from.
struct DomainText {
  std::string file;
  std::string text;
};

/// Keeps the plan if it still leads to the goal from the state, else finds another one. Learns from
/// a sensor that was used in vain: what its `:negcondition` says.
FoundPlan continue_plan(const DomainText& domain, const FindPlan& request,
                        const PlanningOptions& options);

} // namespace castor::planning
