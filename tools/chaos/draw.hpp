#pragma once

#include "castor/tools/chaos/fault.hpp"
#include "castor/tools/chaos/fault_targets.hpp"
#include "castor/tools/chaos/seeded_random.hpp"

namespace castor::faults {

/// The fault with names instead of every `any`. The plan must have been checked against the
/// targets: throws std::invalid_argument if there is nothing to draw from.
Fault draw_targets(Fault fault, const FaultTargets& targets, SeededRandom& random);

} // namespace castor::faults
