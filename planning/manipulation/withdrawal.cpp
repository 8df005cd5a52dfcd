#include "castor/planning/manipulation/kinematics.hpp"
#include "castor/planning/manipulation/manipulation_planner.hpp"
#include "castor/planning/manipulation/plan_scene.hpp"

#include <utility>

namespace castor::manipulation {

ManipulationResult ManipulationPlanner::go(const Scene& scene, const Configuration& to,
                                           const Configuration& start, double opening,
                                           const std::string& text) const {
  ManipulationPlan plan;
  plan.held = scene.held;
  auto failure = move(plan, scene, start, {to}, opening, "where it rests", text);
  if (!failure)
    return plan;
  if (failure->kind != MotionFailureKind::start_blocked)
    return *std::move(failure);
  // Away from what it touches: up, as far as it comes.
  for (const double height : {0.12, 0.08, 0.05, 0.03, 0.015}) {
    for (const auto& solution : inverse_.solve(raised(tool_pose(arm_, start), height), start)) {
      plan.stages.clear();
      if (checker(scene, opening, {}).contact(solution) || distance(solution, start) > 1)
        continue;
      auto nothing = checker({}, opening, {});
      plan.stages.push_back(straight(nothing, {start, solution}, "draws back", opening));
      if (!move(plan, scene, solution, {to}, opening, "where it rests", text))
        return plan;
    }
  }
  return *std::move(failure);
}

} // namespace castor::manipulation
