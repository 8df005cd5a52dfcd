#include "castor/mapping/planar/braking.hpp"

#include <cmath>

namespace castor::mapping {

double speed_to_stop_within(double way, double latency, double braking) {
  // way = speed * latency + speed^2 / (2 * braking), solved for the speed.
  if (way <= 0)
    return 0;
  return braking * (std::sqrt(latency * latency + 2 * way / braking) - latency);
}

} // namespace castor::mapping
