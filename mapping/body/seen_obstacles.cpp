#include "castor/mapping/body/seen_obstacles.hpp"

#include "castor/mapping/planar/beams.hpp"

#include <cmath>

namespace castor::mapping {

void SeenObstacles::add(const LaserScan& scan, const Pose2& robot) {
  forget(scan, robot);
  const auto scanner = compose(robot, scan.mount);
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
    const double range = scan.ranges[i];
    if (!(range > 0) || range > options_.reach)
      continue;
    const auto point = transform(scanner, end_of_beam(scan, i));
    seen_[cell_of(point, options_.cell_size)] = {point, scan.time};
  }
}

void SeenObstacles::forget(const LaserScan& scan, const Pose2& robot) {
  const auto from = inverse(compose(robot, scan.mount));
  std::erase_if(seen_, [&](const auto& x) {
    if (scan.time - x.second.time > options_.memory)
      return true;
    const auto place = transform(from, x.second.point);
    const double beam = (std::atan2(place.y, place.x) - scan.first_angle) / scan.angle_step;
    const auto nearest = std::lround(beam);
    if (nearest < 0 || nearest >= std::ssize(scan.ranges))
      return false;
    const double range = scan.ranges[static_cast<std::size_t>(nearest)];
    return range > std::hypot(place.x, place.y) + options_.beyond;
  });
}

std::vector<Point2> SeenObstacles::points() const {
  std::vector<Point2> result;
  for (auto& [cell, x] : seen_)
    result.push_back(x.point);
  return result;
}

} // namespace castor::mapping
