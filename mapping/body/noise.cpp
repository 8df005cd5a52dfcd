#include "castor/mapping/body/noise.hpp"

#include <cmath>
#include <numbers>

namespace castor::mapping {

// The distributions of the standard library differ between its implementations.

double Noise::uniform() {
  constexpr double range = 9007199254740992.0; // 2^53
  return (static_cast<double>(random_() >> 11) + 1) / range;
}

double Noise::gaussian(double standard_deviation) {
  // G. E. P. Box and M. E. Muller, "A note on the generation of random normal deviates", 1958.
  const double radius = std::sqrt(-2 * std::log(uniform()));
  return standard_deviation * radius * std::cos(2 * std::numbers::pi * uniform());
}

bool Noise::happens(double probability) {
  return uniform() <= probability;
}

} // namespace castor::mapping
