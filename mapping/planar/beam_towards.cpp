#include "castor/mapping/planar/beam_towards.hpp"

#include <cmath>
#include <numbers>

namespace castor::mapping {

std::optional<std::size_t> beam_towards(const LaserScan& scan, const Point2& point) {
  // Scans go up to once around.
  auto angle = std::fmod(std::atan2(point.y, point.x) - scan.first_angle, 2 * std::numbers::pi);
  if (angle < 0)
    angle += 2 * std::numbers::pi;
  const auto beam = std::lround(angle / scan.angle_step);
  if (beam < 1 || beam + 1 >= static_cast<long>(scan.ranges.size()))
    return std::nullopt;
  return static_cast<std::size_t>(beam);
}

} // namespace castor::mapping
