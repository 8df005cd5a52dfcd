#include "castor/mapping/geometry/poses.hpp"
#include "castor/planning/manipulation/collision_checker.hpp"
#include "castor/planning/manipulation/grasp_candidates.hpp"
#include "castor/planning/manipulation/kinematics.hpp"
#include "castor/planning/manipulation/manipulation_planner.hpp"
#include "castor/planning/manipulation/plan_scene.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace castor::manipulation {

namespace {

using std::numbers::pi;

// A thing is pushed in one of so many directions.
constexpr int directions = 16;
// Between the tool and what it stands on, and how high it pushes at most; metres.
constexpr double least_height = 0.002;
constexpr double most_height = 0.02;
// Between fingers and thing where they go down beside it, metres.
constexpr double beside = 0.03;
// How much further it is pushed, metres.
constexpr double beyond = 0.01;
// The fingers rise above a thing that was pushed, so that they may open there; metres.
constexpr double clear_above = 0.01;
// On all sides of a thing that is pushed, metres.
constexpr double room = 0.012;
// Between configurations of a push, metres.
constexpr double spacing = 0.01;

/// A push in one direction.
struct Push {
  Point3 along;
  /// Of the tool, before the push and after it, from the thing's middle along it.
  double begin = 0;
  double end = 0;
  double height = 0;
  double tilt = 0;
};

NamedSolid moved(NamedSolid x, const Point3& along, double way) {
  x.pose.position.x += way * along.x;
  x.pose.position.y += way * along.y;
  return x;
}

/// Sideways for the arm first.
std::vector<Point3> directions_of(const PushGoal& goal, const Point3& middle) {
  if (goal.along)
    return {*goal.along};
  std::vector<Point3> result;
  for (int i = 0; i < directions; ++i) {
    const double angle = std::atan2(middle.y, middle.x) + pi / 2 +
                         (i % 2 == 0 ? 1 : -1) * pi * ((i + 1) / 2) / directions * 2;
    result.push_back({std::cos(angle), std::sin(angle), 0});
  }
  return result;
}

/// Whether a thing has room on all of its way.
bool has_room(const Scene& others, NamedSolid thing, const Point3& along, double way) {
  thing.solid.size.x += 2 * room;
  thing.solid.size.y += 2 * room;
  constexpr int steps = 8;
  for (int i = 0; i <= steps; ++i) {
    const auto there = moved(thing, along, way * i / steps);
    if (std::ranges::any_of(others.things, [&](const auto& x) { return overlap(x, there); }))
      return false;
  }
  return true;
}

/// The tool on the way of a push; an arm that cannot come from any direction turns with it.
Pose tool_on(const Push& push, const Point3& middle, double way, double raised = 0) {
  const Point3 at{middle.x + way * push.along.x, middle.y + way * push.along.y,
                  push.height + raised};
  const double turret = std::atan2(at.y, at.x);
  const double across = std::sin(push.tilt);
  const Point3 z{across * std::cos(turret), across * std::sin(turret), std::cos(push.tilt)};
  const Point3 y{-std::sin(turret), std::cos(turret), 0};
  const Point3 x{y.y * z.z - y.z * z.y, y.z * z.x - y.x * z.z, y.x * z.y - y.y * z.x};
  return {at, geometry::rotation_from_axes(x, y, z), arm_frame};
}

} // namespace

/// Configurations that bring the tool to these poses one after the other, without contact between.
std::optional<std::vector<Configuration>>
ManipulationPlanner::along(CollisionChecker& checker, const Configuration& start,
                           const std::vector<Pose>& poses) const {
  std::vector<Configuration> result{start};
  for (const auto& pose : poses) {
    constexpr double largest_turn = 0.5;
    auto solutions = inverse_.solve(pose, result.back());
    if (solutions.empty() ||
        manipulation::distance(solutions.front(), result.back()) > largest_turn ||
        !checker.is_free_between(result.back(), solutions.front()))
      return {};
    result.push_back(std::move(solutions.front()));
  }
  return result;
}

ManipulationResult ManipulationPlanner::push(const Scene& scene, const std::string& thing,
                                             const PushGoal& goal,
                                             const Configuration& start) const {
  if (!arm_.gripper)
    return MotionFailure{MotionFailureKind::no_grasp, {}, arm_.name + " has no gripper"};
  const auto& pushed = named(scene, thing);
  const auto& middle = pushed.pose.position;
  const auto supports = supports_of(scene, pushed);
  auto may_touch = supports;
  may_touch.push_back(thing);
  const double closed = arm_.gripper->narrowest;
  auto apart = checker(scene, closed, supports);
  auto pushing = checker(scene, closed, may_touch);
  const auto others = without(scene, may_touch);
  const double half = half_height(pushed.solid, pushed.pose.rotation);
  std::optional<MotionFailure> failure;
  std::vector<Contact> contacts;
  std::size_t tried = 0;
  const double way = goal.along ? goal.distance : goal.distance + beyond;
  for (const auto& direction : directions_of(goal, middle)) {
    Push push;
    push.along = direction;
    const double extent = half_extent(pushed, push.along) + arm_.gripper->finger.x;
    push.begin = -extent - beside;
    push.end = way - half_extent(pushed, push.along);
    // The fingers are before the tool; who says no direction wants it away, however far.
    if (goal.along)
      push.end -= arm_.gripper->finger.x / 2;
    // Low, so that the thing does not tip.
    push.height =
      middle.z - half + std::clamp(half, least_height, most_height) + arm_.gripper->beyond;
    const double tips = push.height - arm_.gripper->beyond;
    const double lift = std::max(options_.lift, middle.z + half + clear_above - tips);
    const auto there = moved(pushed, push.along, way);
    const bool may_be_there = !goal.may_end_at || goal.may_end_at(there.pose.position);
    if (!may_be_there || !has_room(others, pushed, push.along, way))
      continue;
    for (const double tilt : options_.grasps.tilts) {
      push.tilt = tilt;
      const auto begin = tool_on(push, middle, push.begin);
      for (const auto& solution : inverse_.solve(begin, start)) {
        if (auto contact = apart.contact(solution)) {
          contacts.push_back(*std::move(contact));
          continue;
        }
        std::vector<Pose> poses;
        for (double at = push.begin + spacing; at < push.end; at += spacing)
          poses.push_back(tool_on(push, middle, at));
        poses.push_back(tool_on(push, middle, push.end));
        std::vector<Pose> up;
        for (double height = spacing; height <= options_.lift; height += spacing)
          up.push_back(tool_on(push, middle, push.begin, height));
        auto down = along(apart, solution, up);
        auto on = along(pushing, solution, poses);
        if (!down || !on)
          continue;
        up.clear();
        for (double height = spacing; height < lift + spacing; height += spacing)
          up.push_back(tool_on(push, middle, push.end, std::min(height, lift)));
        const auto away = along(pushing, on->back(), up);
        if (!away || tried == most_tried)
          continue;
        ++tried;
        std::ranges::reverse(*down);
        ManipulationPlan plan;
        failure =
          move(plan, scene, start, {down->front()}, closed, thing, "reaches beside " + thing);
        if (failure)
          continue;
        plan.stages.push_back(straight(apart, *down, "goes down beside " + thing, closed));
        plan.stages.push_back(straight(pushing, *on, "pushes " + thing, closed));
        plan.stages.back().status = ManipulationStatus::pushing;
        plan.stages.back().pushes = true;
        plan.stages.push_back(straight(pushing, *away, "withdraws from " + thing, closed));
        plan.goal = there.pose;
        return plan;
      }
    }
  }
  if (failure)
    return *std::move(failure);
  if (!contacts.empty())
    return blocked_goal(contacts, thing);
  return MotionFailure{MotionFailureKind::out_of_reach,
                       {},
                       thing + (goal.along
                                  ? " cannot be pushed there: there is no room for it and the arm"
                                  : " cannot be pushed aside: in no direction is there room for "
                                    "it, and the arm within reach")};
}

} // namespace castor::manipulation
