#pragma once

#include "castor/tools/chaos/workload.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace castor::faults {

/// An action and its time.
struct DueAction {
  /// Since the start of the system.
  Timestamp at{0};
  Action action;
  /// Index of its statement in the workload.
  std::size_t statement = 0;

  friend bool operator==(const DueAction&, const DueAction&) = default;
};

/// All actions of a workload within the duration, in order of time; those at one time in the order
/// of its lines. Determined by workload, seed and duration. What is drawn for a statement does not
/// depend on other statements, except on identical ones before it. Throws std::length_error if a
/// statement results in too many actions.
std::vector<DueAction> schedule_of(const Workload& workload, std::uint64_t seed,
                                   Timestamp duration);

} // namespace castor::faults
