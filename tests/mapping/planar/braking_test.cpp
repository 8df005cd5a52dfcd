#include "castor/mapping/planar/braking.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

namespace castor::mapping {

RC_GTEST_PROP(SpeedToStopWithin, StopsExactlyThere, ()) {
  const double way = *rc::gen::inRange(1, 12'000) * 0.001;
  const double latency = *rc::gen::inRange(0, 500) * 0.001;
  const double braking = *rc::gen::inRange(100, 3'000) * 0.001;
  const double speed = speed_to_stop_within(way, latency, braking);
  RC_ASSERT(std::abs(speed * latency + speed * speed / (2 * braking) - way) < 1e-9);
  RC_ASSERT(speed_to_stop_within(-way, latency, braking) == 0);
}

} // namespace castor::mapping
