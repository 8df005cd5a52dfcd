#pragma once

#include <cstdint>
#include <random>

namespace castor::mapping {

/// Random numbers that depend on the seed alone.
class Noise {
public:
  explicit Noise(std::uint64_t seed) : random_(seed) {
    // nop
  }

  /// Normally distributed.
  double gaussian(double standard_deviation);

  bool happens(double probability);

private:
  /// In (0, 1].
  double uniform();

  std::mt19937_64 random_;
};

} // namespace castor::mapping
