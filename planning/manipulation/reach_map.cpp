#include "castor/planning/manipulation/reach_map.hpp"

#include "castor/mapping/geometry/poses.hpp"
#include "castor/planning/manipulation/collision_checker.hpp"
#include "castor/planning/manipulation/plan_scene.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace castor::manipulation {

namespace {

/// The tool, some way back along its own z axis.
Pose back(Pose tool, double distance) {
  const auto axis = geometry::rotate(tool.rotation, Point3{0, 0, 1});
  tool.position.x -= distance * axis.x;
  tool.position.y -= distance * axis.y;
  tool.position.z -= distance * axis.z;
  return tool;
}

/// Above, or above and nearer to the arm.
bool can_lift(const InverseKinematics& inverse, const Pose& tool, double lift,
              const Configuration& near) {
  const double away = std::max(1e-6, std::hypot(tool.position.x, tool.position.y));
  return std::ranges::any_of(std::vector{0.0, 1.0}, [&](double inwards) {
    auto above = raised(tool, lift);
    above.position.x -= inwards * lift * tool.position.x / away;
    above.position.y -= inwards * lift * tool.position.y / away;
    return !inverse.solve(above, near).empty();
  });
}

std::size_t tilt_index(const GraspOptions& options, double tilt) {
  const auto nearest =
    std::ranges::min_element(options.tilts, {}, [tilt](double x) { return std::abs(x - tilt); });
  return static_cast<std::size_t>(nearest - options.tilts.begin());
}

} // namespace

spatial::ReachableTable reach_map(const ArmModel& arm, const InverseKinematics& inverse,
                                  const Pose& at, const ReachMapOptions& options) {
  auto grasps = options.grasps;
  // What is round looks the same from all sides.
  grasps.turns = 1;
  spatial::ReachableTable result;
  result.low = {-options.width / 2, -options.depth / 2};
  result.step = options.step;
  const auto points = [&](double length) {
    return static_cast<std::uint32_t>(std::floor(length / options.step + 1e-6)) + 1;
  };
  result.columns = points(options.width);
  result.rows = points(options.depth);
  result.heights = options.heights;
  const auto to_arm = geometry::inverse(at, arm_frame);
  CollisionOptions collisions;
  collisions.opening = options.thickness + grasps.spare;
  CollisionChecker checker(arm, {{table_top(table_length, table_length)}, {}}, collisions);
  const auto can_grasp = [&](const NamedSolid& thing, const Pose& tool) {
    const auto solutions = inverse.solve(tool, arm.home);
    return std::ranges::any_of(solutions, [&](const auto& x) { return checker.is_free(x); }) &&
           !inverse.solve(back(tool, way_out(arm, thing, tool, grasps)), arm.home).empty() &&
           can_lift(inverse, tool, options.lift, arm.home);
  };
  for (const double height : options.heights)
    for (std::uint32_t row = 0; row < result.rows; ++row)
      for (std::uint32_t column = 0; column < result.columns; ++column) {
        const Point3 middle{result.low.x + column * options.step, result.low.y + row * options.step,
                            height / 2};
        const NamedSolid thing{"the thing",
                               cylinder(options.thickness, height),
                               {geometry::transform(to_arm, middle), {}, arm_frame}};
        std::uint32_t ways = 0;
        for (const auto& x : grasp_candidates(arm, thing, inverse.is_closed_form(), grasps)) {
          const auto way = std::uint32_t{1} << tilt_index(options.grasps, x.tilt);
          if ((ways & way) == 0 && can_grasp(thing, x.tool))
            ways |= way;
        }
        result.ways.push_back(ways);
      }
  return result;
}

bool is_reached(const spatial::ReachableTable& reach, const spatial::GroundPoint& at) {
  const double column = std::round((at.x - reach.low.x) / reach.step);
  const double row = std::round((at.y - reach.low.y) / reach.step);
  if (!(column >= 0 && row >= 0 && column < reach.columns && row < reach.rows))
    return false;
  const auto point =
    static_cast<std::size_t>(row) * reach.columns + static_cast<std::size_t>(column);
  const std::size_t layer = std::size_t{reach.rows} * reach.columns;
  for (std::size_t i = point; i < reach.ways.size(); i += layer)
    if (reach.ways[i] != 0)
      return true;
  return false;
}

std::uint32_t ways_held(const Pose& held, const GraspOptions& options) {
  // Of the tool's z axis in the thing's frame.
  const auto up = geometry::rotate(held.rotation, Point3{0, 0, 1});
  const double tilt = std::acos(std::clamp(up.z, -1.0, 1.0));
  constexpr double nearly = 0.2; // radians
  if (options.tilts.empty() || tilt < std::ranges::min(options.tilts) - nearly)
    return spatial::ReachableTable{}.held_ways;
  return std::uint32_t{1} << tilt_index(options, tilt);
}

} // namespace castor::manipulation
