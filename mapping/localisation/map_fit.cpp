#include "castor/mapping/localisation/map_fit.hpp"

#include "castor/mapping/planar/poses.hpp"

#include <algorithm>
#include <cmath>

namespace castor::mapping {

bool MapFit::is_explained(const Pose2& scanner, double angle, double range) const {
  auto dx = std::cos(scanner.heading + angle);
  auto dy = std::sin(scanner.heading + angle);
  if (map_->to_surface(scanner.x + range * dx, scanner.y + range * dy) > options_.near)
    return false;
  // Steps from the scanner, each as long as nothing can be in the way.
  auto cell = map_->cell_size();
  for (double way = 0; way < range - options_.before_end;) {
    auto left = map_->to_occupied(scanner.x + way * dx, scanner.y + way * dy);
    if (left <= 0)
      return false;
    way += std::max(cell / 2, static_cast<double>(left) - cell);
  }
  return true;
}

double MapFit::explained(const LaserScan& scan, const Pose2& robot) const {
  auto scanner = compose(robot, scan.mount);
  auto each =
    std::max<std::size_t>(1, scan.ranges.size() / std::max<std::size_t>(1, options_.beams));
  std::size_t beams = 0;
  std::size_t explained = 0;
  for (std::size_t i = 0; i < scan.ranges.size(); i += each) {
    if (!(scan.ranges[i] > 0) || scan.ranges[i] >= scan.max_range)
      continue;
    ++beams;
    explained += is_explained(scanner, scan.first_angle + static_cast<double>(i) * scan.angle_step,
                              static_cast<double>(scan.ranges[i]))
                   ? 1
                   : 0;
  }
  return beams == 0 ? 1 : static_cast<double>(explained) / static_cast<double>(beams);
}

} // namespace castor::mapping
