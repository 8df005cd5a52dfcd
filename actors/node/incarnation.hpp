#pragma once

#include <cstdint>
#include <random>

namespace castor {

/// Differs from every other, in whatever process; never 0.
inline std::uint64_t new_incarnation() {
  std::random_device random;
  return static_cast<std::uint64_t>(random()) << 32 | random() | 1;
}

} // namespace castor
