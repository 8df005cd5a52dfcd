#pragma once

#include "castor/tools/chaos/fault.hpp"
#include "castor/tools/chaos/fault_targets.hpp"
#include "castor/tools/chaos/seeded_random.hpp"

namespace castor::faults {

/// The fault with every `any` replaced by a randomly chosen name. The plan must have been checked
/// against the targets: throws std::invalid_argument if there is no possible target.
Fault draw_targets(Fault fault, const FaultTargets& targets, SeededRandom& random);

} // namespace castor::faults
