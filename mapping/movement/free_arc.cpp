#include "castor/mapping/movement/free_arc.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace castor::mapping {

double free_arc(const Pose2& robot, const Twist2& velocity, std::span<const Point2> points,
                double radius, double gap, double farthest) {
  if (velocity.forward == 0)
    return farthest;
  constexpr double step = 0.02;   // metres
  constexpr double nearer = 1e-3; // metres, for the rounding of arcs
  const Point2 from{robot.x, robot.y};
  std::vector<Point2> near;
  for (auto& x : points)
    if (distance(x, from) < farthest + radius + gap)
      near.push_back(x);
  for (double way = step; way <= farthest; way += step) {
    const auto there = moved(robot, velocity, way / std::abs(velocity.forward));
    for (auto& x : near) {
      const double least = std::min(radius + gap, distance(x, from) - nearer);
      if (distance(x, {there.x, there.y}) < least)
        return way - step;
    }
  }
  return farthest;
}

} // namespace castor::mapping
