#pragma once

#include "castor/actors/cast/description.hpp"
#include "castor/tools/chaos/fault_plan.hpp"
#include "castor/tools/chaos/fault_targets.hpp"

#include <optional>
#include <string>

namespace castor::cli {

/// The possible targets of faults in a system whose hosts are nodes of these names.
faults::FaultTargets targets_in(const ArchitectureDescription& architecture);

/// Prints what of a plan cannot be brought about; whether that is nothing.
bool is_possible(const faults::FaultPlan& plan, const faults::FaultTargets& targets);

/// Reads a fault plan and prints whatever is wrong with it; nothing if it cannot be brought about.
std::optional<faults::FaultPlan> read_plan(const std::string& file,
                                           const faults::FaultTargets& targets);

} // namespace castor::cli
