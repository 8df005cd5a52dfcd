#include "castor/mapping/body/free_way.hpp"

#include "castor/mapping/planar/poses.hpp"

#include <algorithm>
#include <cmath>

namespace castor::mapping {

double free_way(const LaserScan& scan, double half_width) {
  double result = scan.max_range;
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
    const double range = scan.ranges[i];
    if (!(range > 0))
      continue;
    const double angle = scan.first_angle + static_cast<double>(i) * scan.angle_step;
    const auto seen =
      transform(scan.mount, Point2{range * std::cos(angle), range * std::sin(angle)});
    if (seen.x > 0 && std::abs(seen.y) < half_width)
      result = std::min(result, seen.x);
  }
  return result;
}

} // namespace castor::mapping
