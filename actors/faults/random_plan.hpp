#pragma once

#include "castor/actors/faults/fault_plan.hpp"
#include "castor/actors/faults/fault_targets.hpp"

#include <cstdint>

namespace castor::faults {

/// How much a plan that nobody has written asks of a system.
struct RandomPlanOptions {
  /// Between the beginnings of two faults, on average.
  Timestamp interval = std::chrono::seconds{2};
  /// No fault lasts longer.
  Timestamp longest = std::chrono::seconds{3};
  /// At the end nothing fails, so that the system can recover; in short runs, for a quarter of the
  /// duration.
  Timestamp rest = std::chrono::seconds{10};
};

/// A mix of all that can befall a system of that kind: nothing that it could not survive, so no end
/// of a working memory without a journal, and no fault without an end. The plan names times and
/// targets; it follows from the seed, and is the same on every machine.
FaultPlan random_plan(const FaultTargets& targets, std::uint64_t seed, Timestamp duration,
                      const RandomPlanOptions& options = {});

} // namespace castor::faults
