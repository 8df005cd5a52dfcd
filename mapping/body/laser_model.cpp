#include "castor/mapping/body/laser_model.hpp"

#include <algorithm>
#include <numbers>
#include <stdexcept>

namespace castor::mapping {

LaserModel::LaserModel(const LaserOptions& options, std::uint64_t seed)
  : options_(options), noise_(seed) {
  if (options.field_of_view < 1 || options.field_of_view > 360 || options.beams_per_degree < 1 ||
      !(options.max_range > 0) || !(options.range_noise >= 0))
    throw std::invalid_argument("a laser has a field of view of 1 to 360 degrees, beams, and a "
                                "positive range");
}

LaserScan LaserModel::scan(const Obstacles& fixed, std::span<const Disc> moving, const Pose2& robot,
                           std::int64_t time) {
  constexpr double degree = std::numbers::pi / 180;
  LaserScan result;
  result.time = time;
  result.mount = options_.mount;
  result.first_angle = -options_.field_of_view * degree / 2;
  result.angle_step = degree / options_.beams_per_degree;
  result.max_range = options_.max_range;
  const int steps = options_.field_of_view * options_.beams_per_degree;
  const int beams = options_.field_of_view == 360 ? steps : steps + 1;
  const auto scanner = compose(robot, options_.mount);
  const Point2 origin{scanner.x, scanner.y};
  result.ranges.reserve(static_cast<std::size_t>(beams));
  for (int i = 0; i < beams; ++i) {
    const double direction = scanner.heading + result.first_angle + i * result.angle_step;
    auto hit = fixed.cast(origin, direction, options_.max_range);
    for (const auto& disc : moving)
      if (auto other = cast(disc, origin, direction, hit.value_or(options_.max_range)))
        hit = other;
    double range = 0;
    if (hit && !noise_.happens(options_.missing)) {
      constexpr double shortest = 0.001;
      range = std::max(shortest, *hit + noise_.gaussian(options_.range_noise));
      if (range > options_.max_range)
        range = 0;
    }
    result.ranges.push_back(static_cast<float>(range));
  }
  return result;
}

} // namespace castor::mapping
