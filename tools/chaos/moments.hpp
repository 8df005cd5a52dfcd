#pragma once

#include "castor/tools/chaos/fault_plan.hpp"

#include <cstdint>
#include <string_view>
#include <vector>

namespace castor::faults {

/// When a statement's time comes, in order and before the end of `duration`: follows from the seed
/// and from `purpose`, which tells statements apart. Nothing for what comes after changes.
/// Throws std::length_error for more moments than anybody could make sense of.
std::vector<Timestamp> moments_of(const Trigger& trigger, std::uint64_t seed,
                                  std::string_view purpose, Timestamp duration);

} // namespace castor::faults
