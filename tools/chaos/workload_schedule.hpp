#pragma once

#include "castor/tools/chaos/workload.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace castor::faults {

/// Something that is to be done at that time.
struct DueAction {
  /// Since the system has started.
  Timestamp at{0};
  Action action;
  /// Which statement of the workload it comes from.
  std::size_t statement = 0;

  friend bool operator==(const DueAction&, const DueAction&) = default;
};

/// All that a workload does within the duration, in order; at one time in the order of its lines.
/// Which and when follows from workload, seed and duration. What is drawn for a statement depends
/// on no other statement, unless one is written like it.
/// Throws std::length_error if a statement comes to more than anybody could make sense of.
std::vector<DueAction> schedule_of(const Workload& workload, std::uint64_t seed,
                                   Timestamp duration);

} // namespace castor::faults
