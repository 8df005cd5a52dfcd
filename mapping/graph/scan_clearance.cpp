#include "castor/mapping/graph/scan_clearance.hpp"

#include "castor/mapping/planar/beams.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

namespace castor::mapping {

namespace {

/// Longer beams are too far apart to say much; metres.
constexpr double longest_beam = 5;
/// Keyframes whose robot was in this distance of the middle of a line count, metres, those nearest,
/// and of those nearer to one another than `apart` one.
constexpr double near = 3;
constexpr double apart = 0.3;
constexpr std::size_t most = 14;

} // namespace

void ScanClearance::add(std::int64_t keyframe, const Pose2& robot, const LaserScan& scan,
                        const std::vector<bool>& ignored) {
  Seen x;
  x.robot = robot;
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
    const double range = scan.ranges[i];
    if (!(range > 0) || range > longest_beam || range >= scan.max_range ||
        (!ignored.empty() && ignored[i]))
      continue;
    x.points.push_back(transform(scan.mount, end_of_beam(scan, i)));
  }
  remove(keyframe);
  squares_[square_of({robot.x, robot.y})].insert(keyframe);
  seen_.emplace(keyframe, std::move(x));
}

void ScanClearance::remove(std::int64_t keyframe) {
  const auto x = seen_.find(keyframe);
  if (x == seen_.end())
    return;
  squares_[square_of({x->second.robot.x, x->second.robot.y})].erase(keyframe);
  seen_.erase(x);
}

void ScanClearance::move(std::int64_t keyframe, const Pose2& robot) {
  const auto x = seen_.find(keyframe);
  if (x == seen_.end())
    return;
  auto& known = x->second.robot;
  squares_[square_of({known.x, known.y})].erase(keyframe);
  squares_[square_of({robot.x, robot.y})].insert(keyframe);
  known = robot;
}

ScanClearance::Square ScanClearance::square_of(const Point2& x) {
  return {static_cast<std::int64_t>(std::floor(x.x)), static_cast<std::int64_t>(std::floor(x.y))};
}

std::vector<const ScanClearance::Seen*> ScanClearance::seen_near(const Line2& line) const {
  const Point2 middle{(line.a.x + line.b.x) / 2, (line.a.y + line.b.y) / 2};
  std::vector<std::pair<double, const Seen*>> candidates;
  const auto low = square_of({middle.x - near, middle.y - near});
  const auto high = square_of({middle.x + near, middle.y + near});
  for (auto column = low.first; column <= high.first; ++column)
    for (auto at = squares_.lower_bound({column, low.second});
         at != squares_.end() && at->first <= Square{column, high.second}; ++at)
      for (auto number : at->second) {
        const auto& x = seen_.at(number);
        if (const auto far = distance(middle, {x.robot.x, x.robot.y}); far < near)
          candidates.emplace_back(far, &x);
      }
  std::ranges::sort(candidates);
  std::vector<const Seen*> result;
  for (auto& [far, x] : candidates) {
    // Those that faced another way have seen something else.
    auto is_alike = [&](const Seen* other) {
      return distance(other->robot, x->robot) < apart &&
             std::abs(normalised(other->robot.heading - x->robot.heading)) < 1;
    };
    if (std::ranges::none_of(result, is_alike))
      result.push_back(x);
    if (result.size() == most)
      break;
  }
  return result;
}

double ScanClearance::clearance(const Line2& line, double limit) const {
  // The nearest three points; two may be noise.
  std::array<double, 3> nearest{limit, limit, limit};
  for (auto* x : seen_near(line)) {
    const auto to_robot = inverse(x->robot);
    const Line2 on_robot{transform(to_robot, line.a), transform(to_robot, line.b)};
    for (auto& p : x->points) {
      auto far = distance(on_robot, p);
      if (far >= nearest[2])
        continue;
      nearest[2] = far;
      std::ranges::sort(nearest);
    }
  }
  return nearest[2];
}

} // namespace castor::mapping
