#pragma once

#include "castor/tools/chaos/fault_plan.hpp"

#include <cstdint>
#include <string_view>
#include <vector>

namespace castor::faults {

/// Times at which a trigger fires, in order and before the end of `duration`; determined by the
/// seed and by `purpose`, which distinguishes statements. Empty for After. Throws std::length_error
/// if there are too many.
std::vector<Timestamp> moments_of(const Trigger& trigger, std::uint64_t seed,
                                  std::string_view purpose, Timestamp duration);

} // namespace castor::faults
