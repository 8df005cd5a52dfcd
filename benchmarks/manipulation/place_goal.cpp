#include "castor/benchmarks/manipulation/place_goal.hpp"

#include "castor/mapping/geometry/poses.hpp"
#include "castor/planning/manipulation/arm_placement.hpp"

namespace castor::manipulation {

PlaceGoal goal_at(const Spot& spot) {
  const auto to_arm = geometry::inverse(arm_placement(benchmark_arm_at), arm_frame);
  PlaceGoal result;
  result.bottom = geometry::transform(to_arm, Point3{spot.x, spot.y, 0});
  result.radius = 0.01;
  result.support = "the table";
  return result;
}

} // namespace castor::manipulation
