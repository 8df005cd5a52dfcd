#include "castor/planning/manipulation/straight_motion.hpp"

#include "castor/mapping/geometry/poses.hpp"
#include "castor/planning/manipulation/kinematics.hpp"

#include <algorithm>
#include <cmath>

namespace castor::manipulation {

namespace {

// Radians of turning that count as one metre, when steps are divided.
constexpr double radians_per_metre = 10;
// A joint that turns further between two configurations has another posture.
constexpr double largest_turn = 0.5;

} // namespace

std::optional<std::vector<Configuration>>
straight_motion(const ArmModel& arm, const InverseKinematics& inverse, CollisionChecker& checker,
                const Configuration& from, const Pose& tool, double spacing) {
  auto begin = tool_pose(arm, from);
  begin.frame = tool.frame;
  const double length =
    std::max(geometry::distance(begin.position, tool.position),
             geometry::angle_between(begin.rotation, tool.rotation) / radians_per_metre);
  const int steps = std::max(1, static_cast<int>(std::ceil(length / spacing - 1e-6)));
  std::vector<Configuration> result{from};
  for (int i = 1; i <= steps; ++i) {
    const auto pose = geometry::interpolate(begin, tool, static_cast<double>(i) / steps);
    auto solutions = inverse.solve(pose, result.back());
    if (solutions.empty() || distance(solutions.front(), result.back()) > largest_turn ||
        !checker.is_free_between(result.back(), solutions.front()))
      return {};
    result.push_back(std::move(solutions.front()));
  }
  return result;
}

std::optional<std::vector<Configuration>>
way_back(const ArmModel& arm, const InverseKinematics& inverse, CollisionChecker& checker,
         const Configuration& from, const Pose& tool, std::span<const double> distances) {
  for (const double distance : distances) {
    auto back = tool;
    back.position = geometry::transform(tool, Point3{0, 0, -distance});
    if (auto way = straight_motion(arm, inverse, checker, from, back))
      return way;
  }
  return {};
}

} // namespace castor::manipulation
