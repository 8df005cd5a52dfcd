#pragma once

#include "castor/actors/cast/description.hpp"
#include "castor/tools/chaos/fault_plan.hpp"
#include "castor/tools/chaos/fault_targets.hpp"

#include <optional>
#include <string>

namespace castor::cli {

/// The possible targets of faults in a system; its hosts are nodes of the same names.
faults::FaultTargets targets_in(const ArchitectureDescription& architecture);

/// Prints the faults of a plan that cannot be injected; true if there are none.
bool is_possible(const faults::FaultPlan& plan, const faults::FaultTargets& targets);

/// Reads a fault plan and prints all findings about it; nothing if there are errors.
std::optional<faults::FaultPlan> read_plan(const std::string& file,
                                           const faults::FaultTargets& targets);

} // namespace castor::cli
