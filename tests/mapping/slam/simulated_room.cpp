#include "castor/tests/mapping/slam/simulated_room.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace castor::mapping::test {

namespace {

void add_box(std::vector<Wall>& walls, double left, double bottom, double right, double top) {
  walls.push_back({{left, bottom}, {right, bottom}});
  walls.push_back({{right, bottom}, {right, top}});
  walls.push_back({{right, top}, {left, top}});
  walls.push_back({{left, top}, {left, bottom}});
}

// Distance along the beam; infinite if it misses.
double range_to(const Wall& wall, const Point2& from, double angle) {
  auto dx = std::cos(angle);
  auto dy = std::sin(angle);
  auto wx = wall.to.x - wall.from.x;
  auto wy = wall.to.y - wall.from.y;
  auto ax = wall.from.x - from.x;
  auto ay = wall.from.y - from.y;
  auto cross = dx * wy - dy * wx;
  auto range = (ax * wy - ay * wx) / cross;
  auto along = (ax * dy - ay * dx) / cross;
  if (std::abs(cross) > 1e-12 && range > 0 && along >= 0 && along <= 1)
    return range;
  return std::numeric_limits<double>::infinity();
}

} // namespace

std::vector<Wall> furnished_room() {
  std::vector<Wall> result;
  add_box(result, 0, 0, 10, 8);
  add_box(result, 3, 3, 7, 5);
  add_box(result, 0.2, 0, 1, 0.5);
  add_box(result, 4, 0, 5.5, 0.3);
  add_box(result, 9.4, 2, 10, 3.5);
  add_box(result, 8, 7.5, 9, 8);
  add_box(result, 2, 7.3, 2.6, 8);
  add_box(result, 0, 4, 0.4, 6);
  result.push_back({{5, 8}, {6, 7.2}});
  return result;
}

std::vector<Wall> endless_corridor() {
  return {{{-1000, -1}, {1000, -1}}, {{-1000, 1}, {1000, 1}}};
}

std::vector<Wall> person_at(const Point2& place) {
  constexpr int sides = 8;
  constexpr double radius = 0.25;
  const auto corner = [&](int i) {
    const double angle = 2 * std::numbers::pi * i / sides;
    return Point2{place.x + radius * std::cos(angle), place.y + radius * std::sin(angle)};
  };
  std::vector<Wall> result;
  for (int i = 0; i < sides; ++i)
    result.push_back({corner(i), corner(i + 1)});
  return result;
}

LaserScan scan_from(const std::vector<Wall>& walls, const Pose2& robot, std::int64_t time,
                    std::size_t beams, double view) {
  LaserScan result;
  result.time = time;
  result.first_angle = -view / 2;
  result.angle_step = view / static_cast<double>(beams - 1);
  result.max_range = 30;
  for (std::size_t i = 0; i < beams; ++i) {
    auto angle = robot.heading + result.first_angle + static_cast<double>(i) * result.angle_step;
    auto range = std::numeric_limits<double>::infinity();
    for (const auto& wall : walls)
      range = std::min(range, range_to(wall, {robot.x, robot.y}, angle));
    result.ranges.push_back(range < result.max_range ? static_cast<float>(range) : 0.F);
  }
  return result;
}

LaserScan with_noise(LaserScan scan, double deviation, std::mt19937& random) {
  std::normal_distribution<double> normal{0, deviation};
  for (auto& x : scan.ranges)
    if (x > 0)
      x = std::max(0.01F, x + static_cast<float>(normal(random)));
  return scan;
}

std::vector<Pose2> path_around(double rounds) {
  const std::vector<Point2> corners{{2, 1.7}, {8, 1.7}, {8, 6.2}, {2, 6.2}};
  constexpr double step = 0.05;
  std::vector<Pose2> result{{corners[0].x, corners[0].y, 0}};
  auto legs = static_cast<std::size_t>(std::lround(4 * rounds));
  for (std::size_t leg = 0; leg < legs; ++leg) {
    auto to = corners[(leg + 1) % 4];
    auto direction = std::atan2(to.y - result.back().y, to.x - result.back().x);
    while (std::abs(normalised(direction - result.back().heading)) > 1e-9) {
      auto next = result.back();
      auto turn = normalised(direction - next.heading);
      next.heading = normalised(next.heading + std::clamp(turn, -step, step));
      result.push_back(next);
    }
    for (auto left = distance(to, Point2{result.back().x, result.back().y}); left > 1e-9;
         left -= step)
      result.push_back(compose(result.back(), {std::min(left, step), 0, 0}));
  }
  return result;
}

namespace {

/// Elsewhere than the path begins.
constexpr Pose2 odometry_start{5, -3, 1};

} // namespace

Pose2 in_map(const std::vector<Pose2>& path, std::size_t i) {
  return compose(odometry_start, between(path.at(0), path.at(i)));
}

std::vector<Pose2> odometry_of(const std::vector<Pose2>& path, double drift) {
  std::vector<Pose2> result{odometry_start};
  for (std::size_t i = 1; i < path.size(); ++i) {
    auto step = between(path[i - 1], path[i]);
    step.x *= 1.03;
    step.heading += drift * std::abs(step.x);
    result.push_back(compose(result.back(), step));
  }
  return result;
}

} // namespace castor::mapping::test
