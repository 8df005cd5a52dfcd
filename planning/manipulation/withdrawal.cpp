#include "castor/mapping/geometry/poses.hpp"
#include "castor/planning/manipulation/kinematics.hpp"
#include "castor/planning/manipulation/manipulation_planner.hpp"
#include "castor/planning/manipulation/plan_scene.hpp"
#include "castor/planning/manipulation/scene.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

namespace castor::manipulation {

namespace {

/// Metres that the tool draws back at most, and in steps.
constexpr double farthest = 0.12;
constexpr double step = 0.01;
/// Radians that a joint turns in such a step.
constexpr double most_turn = 0.3;
constexpr const char* destination = "where it rests";

/// As they are seen.
Scene exactly(Scene scene) {
  const auto make_exact = [](NamedSolid& x) { x.uncertainty = x.higher = 0; };
  std::ranges::for_each(scene.things, make_exact);
  if (scene.held)
    make_exact(*scene.held);
  return scene;
}

Point3 unit(const Point3& x) {
  const double length = std::hypot(x.x, x.y, x.z);
  return {x.x / length, x.y / length, x.z / length};
}

/// In which the tool may draw back: the way its fingers came, obliquely, up, and up to the arm.
/// With something in the gripper, up before.
std::vector<Point3> directions_off(const Pose& tool, bool is_holding) {
  const auto back = geometry::rotate(tool.rotation, Point3{0, 0, -1});
  const double away = std::max(1e-6, std::hypot(tool.position.x, tool.position.y));
  const Point3 inwards{-tool.position.x / away, -tool.position.y / away, 0};
  std::vector<Point3> result{back};
  // Straight down there is nothing between both.
  if (back.z < 0.9 && back.z > -0.9)
    result.push_back(unit({back.x, back.y, back.z + 1}));
  result.push_back({0, 0, 1});
  for (const double share : {0.5, 1.0})
    result.push_back(unit({share * inwards.x, share * inwards.y, 1}));
  if (is_holding)
    std::ranges::rotate(result, std::ranges::find(result, 1.0, &Point3::z));
  return result;
}

/// As far as the tool comes in that direction on a straight line.
std::vector<Configuration> way_along(const ArmModel& arm, const InverseKinematics& inverse,
                                     CollisionChecker& checker, const Configuration& start,
                                     const Point3& direction) {
  const auto tool = tool_pose(arm, start);
  std::vector<Configuration> result{start};
  for (double way = step; way < farthest + step / 2; way += step) {
    auto next = tool;
    next.position = {tool.position.x + way * direction.x, tool.position.y + way * direction.y,
                     tool.position.z + way * direction.z};
    auto solutions = inverse.solve(next, result.back());
    if (solutions.empty() || distance(solutions.front(), result.back()) > most_turn ||
        !checker.is_free_between(result.back(), solutions.front()))
      break;
    result.push_back(std::move(solutions.front()));
  }
  return result;
}

} // namespace

/// A way off what the arm touches.
struct ManipulationPlanner::WayOff {
  std::vector<Configuration> waypoints;
  /// What the gripper touches at its beginning.
  std::vector<std::string> touched;
};

/// Names of what the arm touches there, or what is nearer to it than the margin.
std::vector<std::string> ManipulationPlanner::touched(const Scene& scene, const Configuration& at,
                                                      double opening, double margin) const {
  std::vector<std::string> result;
  auto collisions = options_.motions.collisions;
  collisions.opening = opening;
  collisions.margin = margin;
  while (true) {
    collisions.may_touch = result;
    const auto contact = CollisionChecker(arm_, scene, collisions).contact(at);
    // Links may touch nothing in any case.
    if (!contact || contact->is_of_arm || std::ranges::count(result, contact->other) > 0)
      return result;
    result.push_back(contact->other);
  }
}

/// As far as the gripper can open where it is without pushing anything.
double ManipulationPlanner::opened(const Scene& scene, const Configuration& at,
                                   double opening) const {
  const double margin = options_.motions.collisions.margin;
  const auto tool = tool_pose(arm_, at);
  const auto near = touched(scene, at, opening, margin);
  const NamedSolid gap{"", gap_between_fingers(*arm_.gripper, opening), tool};
  const auto seen = exactly(scene);
  // Fingers leave what is between them; what is beside them is not to be nearer than this.
  constexpr double beside = 0.001;
  const auto is_pushed = [&](double wide) {
    const auto is_outside = [&](const std::string& x) { return !overlap(named(scene, x), gap); };
    const auto now = touched(scene, at, wide, margin);
    const auto exact = touched(seen, at, wide, beside);
    return std::ranges::any_of(now, [&](const auto& x) {
      return is_outside(x) &&
             (std::ranges::count(near, x) == 0 || std::ranges::count(exact, x) > 0);
    });
  };
  // So small that fingers do not skip anything.
  constexpr double step = 0.01;
  double result = opening;
  while (result < arm_.gripper->widest) {
    const double wide = std::min(arm_.gripper->widest, result + step);
    if (is_pushed(wide))
      break;
    result = wide;
  }
  return result;
}

/// On these, nothing is touched that is not touched where they begin, and in the end nothing.
std::vector<ManipulationPlanner::WayOff> ManipulationPlanner::ways_off(const Scene& scene,
                                                                       const Configuration& start,
                                                                       double opening) const {
  const auto near = touched(scene, start, opening, options_.motions.collisions.margin);
  const auto seen = exactly(scene);
  auto collisions = options_.motions.collisions;
  collisions.opening = opening;
  collisions.margin = 0;
  collisions.may_touch = touched(seen, start, opening, 0);
  CollisionChecker exact(arm_, seen, collisions);
  auto free = checker(scene, opening, {});
  auto beside = checker(scene, opening, near);
  std::vector<WayOff> result;
  for (const auto& direction : directions_off(tool_pose(arm_, start), scene.held.has_value())) {
    auto way = way_along(arm_, inverse_, beside, start, direction);
    while (way.size() > 1 && !free.is_free(way.back()))
      way.pop_back();
    bool is_exact = way.size() > 1;
    for (std::size_t i = 1; i < way.size() && is_exact; ++i)
      is_exact = exact.is_free_between(way[i - 1], way[i]);
    if (is_exact)
      result.push_back({std::move(way), near});
  }
  return result;
}

/// Draws back, and goes on from there.
std::optional<ManipulationPlan> ManipulationPlanner::withdrawn(const Scene& scene,
                                                               const Configuration& to,
                                                               const Configuration& start,
                                                               double opening,
                                                               const std::string& text) const {
  std::vector<double> openings{opening};
  if (!scene.held && arm_.gripper)
    if (const double wide = opened(scene, start, opening); wide > opening)
      openings.insert(openings.begin(), wide);
  for (const double wide : openings)
    for (const auto& way : ways_off(scene, start, wide)) {
      ManipulationPlan plan;
      plan.held = scene.held;
      if (wide != opening)
        plan.stages.push_back(
          still(start, ManipulationStatus::moving, "opens its gripper", wide, {}));
      auto near = checker(scene, wide, way.touched);
      plan.stages.push_back(straight(near, way.waypoints, "draws back", wide));
      if (!move(plan, scene, way.waypoints.back(), {to}, wide, destination, text))
        return plan;
    }
  return {};
}

ManipulationResult ManipulationPlanner::go(const Scene& scene, const Configuration& to,
                                           const Configuration& start, double opening,
                                           const std::string& text, bool draws_back) const {
  if (draws_back)
    if (auto plan = withdrawn(scene, to, start, opening, text))
      return *std::move(plan);
  ManipulationPlan plan;
  plan.held = scene.held;
  auto failure = move(plan, scene, start, {to}, opening, destination, text);
  if (!failure)
    return plan;
  const bool is_blocked = failure->kind == MotionFailureKind::start_blocked;
  if (!draws_back && (is_blocked || failure->kind == MotionFailureKind::no_way))
    if (auto withdrawal = withdrawn(scene, to, start, opening, text))
      return *std::move(withdrawal);
  // It cannot but touch what it touches already; what is seen may not be there.
  const auto near = touched(scene, start, opening, options_.motions.collisions.margin);
  plan.stages.clear();
  if (is_blocked && !move(plan, without(scene, near), start, {to}, opening, destination, text))
    return plan;
  return *std::move(failure);
}

} // namespace castor::manipulation
