#pragma once

#include <cstddef>
#include <cstdint>
#include <random>

namespace castor::mapping {

/// Random numbers that are the same on all machines for the same seed, which those of the standard
/// library's distributions need not be.
class SeededUniform {
public:
  explicit SeededUniform(std::uint64_t seed) : engine_(seed) {
    // nop
  }

  /// Within [low, high).
  double between(double low, double high) {
    constexpr double unit = 0x1p-53;
    return low + (high - low) * static_cast<double>(engine_() >> 11) * unit;
  }

  bool chance(double share) { return between(0, 1) < share; }

  /// Less than `count`, which is positive.
  std::size_t below(std::size_t count) { return static_cast<std::size_t>(engine_() % count); }

private:
  std::mt19937_64 engine_;
};

} // namespace castor::mapping
