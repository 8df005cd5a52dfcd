#include "castor/mapping/movement/map_alignment.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

namespace castor::mapping {

namespace {

/// Points on the robot that do not belong to those who move.
std::vector<Point2> standing_on_robot(const Pose2& robot, std::span<const Point2> seen,
                                      std::span<const Mover> movers, std::size_t most) {
  constexpr double body = 0.5; // metres
  std::vector<Point2> result;
  const std::size_t step = seen.size() / most + 1;
  const auto from = inverse(robot);
  for (std::size_t i = 0; i < seen.size(); i += step)
    if (std::ranges::none_of(
          movers, [&](const Mover& mover) { return distance(mover.place, seen[i]) < body; }))
      result.push_back(transform(from, seen[i]));
  return result;
}

/// The points of one heading; adding the robot's place moves them onto the map.
std::vector<Point2> turned(const std::vector<Point2>& points, double heading) {
  std::vector<Point2> result;
  for (const auto& x : points)
    result.push_back(transform({0, 0, heading}, x));
  return result;
}

/// How much of the points is on obstacles, from 0 to 1.
double share_on(const ClearanceMap& map, const std::vector<Point2>& turned, const Point2& robot,
                double spread) {
  double result = 0;
  for (const auto& x : turned)
    if (const auto cell = map.cell_at({robot.x + x.x, robot.y + x.y}))
      result += std::max(0.0, 1 - map.at(*cell) / spread);
  return result / static_cast<double>(turned.size());
}

} // namespace

bool MapAlignment::is_aligned(const std::vector<Point2>& turned, const Point2& robot,
                              const ClearanceMap& map) const {
  const auto off = std::ranges::count_if(turned, [&](const Point2& x) {
    const auto cell = map.cell_at({robot.x + x.x, robot.y + x.y});
    return !cell || map.at(*cell) > options_.spread;
  });
  return static_cast<double>(off) < options_.least_gain * static_cast<double>(turned.size());
}

void MapAlignment::look(const Pose2& robot, std::span<const Point2> seen,
                        std::span<const Mover> movers, const PlanningMap& map) {
  const auto points = standing_on_robot(robot, seen, movers, options_.most_points);
  if (points.size() < options_.least_points)
    return;
  const auto& clearance = map.clearance_of_occupied();
  const auto share_at = [&](const Pose2& place) {
    return share_on(clearance, turned(points, place.heading), {place.x, place.y}, options_.spread);
  };
  // Where the pose itself fits better by now, nothing else counts.
  if (share_at(robot) > share_at(on_map(robot)))
    offset_ = {};
  const auto now = on_map(robot);
  const auto as_now = turned(points, now.heading);
  if (is_aligned(as_now, {now.x, now.y}, clearance))
    return;
  const double share_now = share_at(now);
  double most = share_now + options_.least_gain;
  std::optional<Pose2> best;
  const int steps = static_cast<int>(std::lround(options_.most / options_.step));
  const int turns = static_cast<int>(std::lround(options_.most_turn / options_.turn_step));
  for (int turn = -turns; turn <= turns; ++turn) {
    const double heading = normalised(robot.heading + turn * options_.turn_step);
    const double by_turn =
      options_.gain_per_radian * std::abs(normalised(heading - now.heading));
    const auto there = turned(points, heading);
    for (int row = -steps; row <= steps; ++row)
      for (int column = -steps; column <= steps; ++column) {
        const Point2 place{robot.x + column * options_.step, robot.y + row * options_.step};
        const double needed =
          by_turn + options_.gain_per_metre * distance(place, Point2{now.x, now.y});
        const double share = share_on(clearance, there, place, options_.spread);
        if (share < options_.least_share || share - needed <= most)
          continue;
        most = share - needed;
        best = Pose2{place.x, place.y, heading};
      }
  }
  if (best)
    offset_ = {best->x - robot.x, best->y - robot.y, normalised(best->heading - robot.heading)};
}

Pose2 MapAlignment::on_map(const Pose2& robot) const {
  return {robot.x + offset_.x, robot.y + offset_.y, normalised(robot.heading + offset_.heading)};
}

Point2 MapAlignment::on_map(const Pose2& robot, const Point2& point) const {
  return transform(on_map(robot), transform(inverse(robot), point));
}

} // namespace castor::mapping
