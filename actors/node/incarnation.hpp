#pragma once

#include <cstdint>
#include <random>

namespace castor {

/// Random number, unique over all processes; never 0.
inline std::uint64_t new_incarnation() {
  // Once for each thread: opening it costs some 50 microseconds in a virtual machine.
  static thread_local std::random_device random;
  return static_cast<std::uint64_t>(random()) << 32 | random() | 1;
}

} // namespace castor
