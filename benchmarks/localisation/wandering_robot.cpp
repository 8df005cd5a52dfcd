#include "castor/benchmarks/localisation/wandering_robot.hpp"

#include "castor/mapping/body/map_surroundings.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace castor::localisation_benchmark {

namespace {

using std::numbers::pi;

/// People who walk to and fro along 3 m where nothing is in their way.
std::vector<mapping::Walker> walkers(const mapping::CellMap& map, const WanderOptions& options) {
  constexpr double way = 3;
  constexpr double step = 0.2;
  const auto obstacles = mapping::surroundings_in_map(map).obstacles;
  std::vector<mapping::Walker> result;
  constexpr std::uint64_t tries = 10000;
  for (std::uint64_t i = 0; i < tries && std::ssize(result) < options.people; ++i) {
    mapping::Walker x;
    const auto from = random_place(map, x.radius, options.seed * tries + i);
    bool is_free = true;
    for (double at = 0; at <= way; at += step) {
      const auto there = mapping::compose(from, {at, 0, 0});
      is_free = is_free && obstacles->clearance({there.x, there.y}, x.radius) >= x.radius;
    }
    if (!is_free)
      continue;
    const auto to = mapping::compose(from, {way, 0, 0});
    x.route = {{from.x, from.y}, {to.x, to.y}};
    result.push_back(x);
  }
  return result;
}

mapping::BodySurroundings surroundings(const mapping::CellMap& map, const mapping::Pose2& start,
                                       const WanderOptions& options) {
  auto result = mapping::surroundings_in_map(map);
  result.start = start;
  result.people = walkers(map, options);
  std::erase_if(result.people, [&](const mapping::Walker& x) {
    return mapping::distance(x.route.front(), mapping::Point2{start.x, start.y}) < 1;
  });
  return result;
}

mapping::BodyOptions body_options(std::uint64_t seed) {
  mapping::BodyOptions result;
  result.seed = seed;
  result.legs = true;
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
  : options_(options), body_(surroundings(map, start, options), body_options(options.seed)),
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

mapping::CellMap with_boxes(mapping::CellMap map, int boxes, std::uint64_t seed) {
  std::mt19937_64 random{seed};
  std::uniform_real_distribution<double> side{0.2, 0.45};
  for (int i = 0; i < boxes; ++i) {
    const double half_width = side(random);
    const double half_height = side(random);
    const auto at = random_place(map, std::hypot(half_width, half_height) + 0.6, random());
    for (int row = 0; row < map.rows; ++row)
      for (int column = 0; column < map.columns; ++column) {
        const double x = map.origin.x + (column + 0.5) * map.cell_size - at.x;
        const double y = map.origin.y + (row + 0.5) * map.cell_size - at.y;
        if (std::abs(x) <= half_width && std::abs(y) <= half_height)
          map.at(column, row) = 100;
      }
  }
  return map;
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
