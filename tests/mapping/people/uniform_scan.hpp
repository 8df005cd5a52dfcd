#pragma once

#include "castor/mapping/planar/types.hpp"

#include <cstddef>
#include <numbers>

namespace castor::mapping {

/// A scan with a beam for each degree, from the right to the left or all around, whose beams all
/// end at that range.
/// @param degrees of its field of view
inline LaserScan uniform_scan(int degrees, float range) {
  LaserScan result;
  result.angle_step = std::numbers::pi / 180;
  result.first_angle = -degrees / 2.0 * result.angle_step;
  result.max_range = 12;
  result.ranges.assign(static_cast<std::size_t>(degrees == 360 ? 360 : degrees + 1), range);
  return result;
}

} // namespace castor::mapping
