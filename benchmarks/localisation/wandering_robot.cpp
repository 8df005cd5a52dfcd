#include "castor/benchmarks/localisation/wandering_robot.hpp"

#include "castor/mapping/body/map_surroundings.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace castor::localisation_benchmark {

namespace {

using std::numbers::pi;

mapping::BodySurroundings surroundings(const mapping::CellMap& map, const mapping::Pose2& start) {
  auto result = mapping::surroundings_in_map(map);
  result.start = start;
  return result;
}

mapping::BodyOptions body_options(std::uint64_t seed) {
  mapping::BodyOptions result;
  result.seed = seed;
  return result;
}

/// Shortest range between two directions on the robot, radians.
double nearest(const mapping::LaserScan& scan, double from, double to) {
  auto result = scan.max_range;
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
    auto angle = scan.first_angle + static_cast<double>(i) * scan.angle_step;
    if (angle >= from && angle <= to && scan.ranges[i] > 0)
      result = std::min(result, static_cast<double>(scan.ranges[i]));
  }
  return result;
}

} // namespace

WanderingRobot::WanderingRobot(const mapping::CellMap& map, const mapping::Pose2& start,
                               const WanderOptions& options)
  : options_(options), body_(surroundings(map, start), body_options(options.seed)),
    random_(options.seed) {
  scan_ = body_.scan();
}

void WanderingRobot::drive() {
  auto ahead = nearest(scan_, -0.5, 0.5);
  if (turning_ == 0 && ahead < options_.turns_before) {
    auto right = nearest(scan_, -pi / 2, -0.5);
    auto left = nearest(scan_, 0.5, pi / 2);
    auto prefers_left = left > right;
    // Now and then the other way, so as not to go around in one circle.
    if (random_() % 4 == 0)
      prefers_left = !prefers_left;
    turning_ = prefers_left ? 1 : -1;
  } else if (turning_ != 0 && ahead > 1.5 * options_.turns_before) {
    turning_ = 0;
  }
  mapping::Twist2 velocity{options_.speed, 0};
  if (turning_ != 0)
    velocity = {0, turning_};
  else if (nearest(scan_, -pi / 2, 0) < 0.4)
    velocity = {options_.speed / 2, 0.3};
  else if (nearest(scan_, 0, pi / 2) < 0.4)
    velocity = {options_.speed / 2, -0.3};
  body_.command(velocity);
  for (int i = 0; i < 10; ++i)
    body_.step();
  scan_ = body_.scan();
}

mapping::Pose2 random_place(const mapping::CellMap& map, double radius, std::uint64_t seed) {
  auto obstacles = mapping::surroundings_in_map(map).obstacles;
  std::mt19937_64 random{seed};
  auto below = [&random](int count) {
    return static_cast<int>(random() % static_cast<std::uint64_t>(count));
  };
  constexpr int tries = 1000000;
  for (int i = 0; i < tries; ++i) {
    auto column = below(map.columns);
    auto row = below(map.rows);
    mapping::Pose2 result{map.origin.x + (column + 0.5) * map.cell_size,
                          map.origin.y + (row + 0.5) * map.cell_size,
                          (below(3600) / 1800. - 1) * pi};
    auto cell = map.at(column, row);
    if (cell >= 0 && cell < 65 &&
        obstacles->clearance({result.x, result.y}, radius + 0.1) >= radius + 0.1)
      return result;
  }
  throw std::runtime_error("there is no room for the robot in the map");
}

} // namespace castor::localisation_benchmark
