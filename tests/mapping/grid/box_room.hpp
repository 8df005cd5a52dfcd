#pragma once

#include "castor/mapping/planar/poses.hpp"
#include "castor/mapping/planar/types.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

namespace castor::mapping::test {

/// Ranges in a rectangular room, calculated from the distances of its four walls.
struct BoxRoom {
  double left = 0;
  double right = 0;
  double bottom = 0;
  double top = 0;

  double range(const Point2& from, double angle) const {
    auto c = std::cos(angle);
    auto s = std::sin(angle);
    constexpr auto never = std::numeric_limits<double>::infinity();
    auto along = c > 0 ? (right - from.x) / c : c < 0 ? (left - from.x) / c : never;
    auto across = s > 0 ? (top - from.y) / s : s < 0 ? (bottom - from.y) / s : never;
    return std::min(along, across);
  }

  /// A scan of all directions.
  LaserScan scan(const Pose2& robot, int beams = 720, const Pose2& mount = {}) const {
    LaserScan result;
    result.mount = mount;
    result.first_angle = -std::numbers::pi;
    result.angle_step = 2 * std::numbers::pi / beams;
    result.max_range = 50;
    auto scanner = compose(robot, mount);
    for (int i = 0; i < beams; ++i)
      result.ranges.push_back(static_cast<float>(range(
        {scanner.x, scanner.y}, scanner.heading + result.first_angle + i * result.angle_step)));
    return result;
  }
};

} // namespace castor::mapping::test
