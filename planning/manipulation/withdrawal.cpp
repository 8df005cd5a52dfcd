#include "castor/mapping/geometry/poses.hpp"
#include "castor/planning/manipulation/kinematics.hpp"
#include "castor/planning/manipulation/manipulation_planner.hpp"
#include "castor/planning/manipulation/plan_scene.hpp"

#include <string>
#include <utility>
#include <vector>

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
  // Away from what it touches: back, out of the fingers' way, or up; as far as it comes. If it
  // cannot but touch something, then so.
  std::vector<std::string> touched;
  if (const auto contact = checker(scene, opening, {}).contact(start))
    touched.push_back(contact->other);
  auto near = checker(scene, opening, touched);
  auto nothing = checker({}, opening, {});
  const auto tool = tool_pose(arm_, start);
  for (auto* on_the_way : {&near, &nothing})
    for (const double distance : {0.12, 0.08, 0.05, 0.03, 0.015})
      for (const bool is_up : {false, true}) {
        auto to_there = is_up ? raised(tool, distance) : tool;
        if (!is_up)
          to_there.position = geometry::transform(tool, Point3{0, 0, -distance});
        for (const auto& solution : inverse_.solve(to_there, start)) {
          plan.stages.clear();
          if (manipulation::distance(solution, start) > 1 ||
              checker(scene, opening, {}).contact(solution) ||
              !on_the_way->is_free_between(start, solution))
            continue;
          plan.stages.push_back(straight(*on_the_way, {start, solution}, "draws back", opening));
          if (!move(plan, scene, solution, {to}, opening, "where it rests", text))
            return plan;
        }
      }
  return *std::move(failure);
}

} // namespace castor::manipulation
