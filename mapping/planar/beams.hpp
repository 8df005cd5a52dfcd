#pragma once

#include "castor/mapping/planar/poses.hpp"

#include <cmath>
#include <cstddef>

namespace castor::mapping {

/// Where a beam ended, on the scanner; metres.
/// \pre it came back.
inline Point2 end_of_beam(const LaserScan& scan, std::size_t beam) {
  const double range = scan.ranges[beam];
  const double angle = scan.first_angle + static_cast<double>(beam) * scan.angle_step;
  return {range * std::cos(angle), range * std::sin(angle)};
}

} // namespace castor::mapping
