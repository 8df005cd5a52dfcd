#include "castor/planning/manipulation/manipulation_planner.hpp"

#include "castor/mapping/geometry/eigen_bridge.hpp"
#include "castor/mapping/geometry/poses.hpp"
#include "castor/planning/manipulation/kinematics.hpp"
#include "castor/planning/manipulation/plan_scene.hpp"
#include "castor/planning/manipulation/straight_motion.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace castor::manipulation {

namespace {

using std::numbers::pi;

// How often the direction to which an arm has turned is corrected by where its tool comes to be.
constexpr int azimuth_rounds = 6;

double azimuth(const Point3& x) {
  return std::atan2(x.y, x.x);
}

/// The rotation that brings that direction up.
geometry::Rotation upright(const Point3& direction) {
  return geometry::to_rotation(
    Eigen::Quaterniond::FromTwoVectors(geometry::to_eigen(direction), Eigen::Vector3d::UnitZ()));
}

} // namespace

/// A grasp, and what follows from it.
struct ManipulationPlanner::Hold {
  std::string thing;
  Grasp grasp;
  /// Of the gripper around the thing, metres.
  double opening = 0;
  /// The tool where it closes.
  Pose tool;
  /// Names of what the thing stands on.
  std::vector<std::string> supports;
  Scene scene;
  std::vector<Configuration> lift;
};

/// A way down to a place.
struct ManipulationPlanner::Landing {
  /// From above to where the thing is let go.
  std::vector<Configuration> down;
  /// Away from it, with an open gripper.
  std::vector<Configuration> away;
  /// Of the thing.
  Pose goal;
};

ManipulationPlanner::ManipulationPlanner(const ArmModel& arm, const ManipulationOptions& options)
  : arm_(arm), options_(options), inverse_(arm) {
  // nop
}

CollisionChecker ManipulationPlanner::checker(const Scene& scene, double opening,
                                              const std::vector<std::string>& may_touch) const {
  auto collisions = options_.motions.collisions;
  collisions.opening = opening;
  collisions.may_touch = may_touch;
  return {arm_, scene, collisions};
}

MotionStage ManipulationPlanner::straight(CollisionChecker& checker,
                                          const std::vector<Configuration>& waypoints,
                                          std::string text, double opening) const {
  auto timing = options_.timing;
  timing.speed_share *= options_.careful;
  return {ManipulationStatus::moving, std::move(text),
          time_parameterise(arm_, checker, waypoints, timing), opening};
}

MotionStage ManipulationPlanner::still(const Configuration& at, ManipulationStatus status,
                                       std::string text, double opening,
                                       std::optional<bool> holds) const {
  const BlendedPath path({at, at}, {0, 0});
  return {status, std::move(text), time_parameterise(arm_, path), opening, false, holds};
}

/// Adds a motion to one of the goals.
std::optional<MotionFailure>
ManipulationPlanner::move(ManipulationPlan& plan, const Scene& scene, const Configuration& start,
                          const std::vector<Configuration>& goals, double opening,
                          const std::string& destination, const std::string& text) const {
  auto motions = options_.motions;
  motions.collisions.opening = opening;
  ++plan.motions;
  auto result = plan_motion(arm_, scene, start, goals, destination, motions);
  if (auto* failure = std::get_if<MotionFailure>(&result))
    return std::move(*failure);
  auto free = checker(scene, opening, {});
  plan.stages.push_back(
    {ManipulationStatus::moving, text,
     time_parameterise(arm_, free, std::get<JointPath>(result).waypoints, options_.timing),
     opening});
  return {};
}

/// Where the tool may be when it has lifted something: above, or above and nearer to the arm.
std::vector<Pose> ManipulationPlanner::ways_up(const Pose& tool) const {
  const auto& at = tool.position;
  const double away = std::max(1e-6, std::hypot(at.x, at.y));
  std::vector<Pose> result;
  for (const double back : {0.0, 0.5, 1.0})
    for (const double share : {1.0, 0.6}) {
      const double height = share * options_.lift;
      auto above = raised(tool, height);
      above.position.x -= back * height * at.x / away;
      above.position.y -= back * height * at.y / away;
      result.push_back(std::move(above));
    }
  return result;
}

/// Nothing if the thing cannot be lifted.
std::optional<ManipulationPlanner::Hold>
ManipulationPlanner::hold(const Scene& scene, const std::string& thing, const Grasp& grasp) const {
  Hold result;
  result.thing = thing;
  result.grasp = grasp;
  result.opening = grasp.candidate.width;
  const auto& at = grasp.approach.back();
  result.tool = tool_pose(arm_, at);
  result.supports = supports_of(scene, named(scene, thing));
  result.scene = holding(scene, thing, result.tool);
  auto lifting = checker(result.scene, result.opening, result.supports);
  auto free = checker(result.scene, result.opening, {});
  for (const auto& above : ways_up(result.tool)) {
    auto lift = straight_motion(arm_, inverse_, lifting, at, above);
    if (!lift || free.contact(lift->back()))
      continue;
    result.lift = *std::move(lift);
    return result;
  }
  return {};
}

std::optional<MotionFailure> ManipulationPlanner::add_pick(ManipulationPlan& plan,
                                                           const Scene& scene, const Hold& hold,
                                                           const Configuration& start) const {
  const auto& approach = hold.grasp.approach;
  const double open = hold.grasp.opening;
  if (auto failure =
        move(plan, scene, start, {approach.front()}, open, hold.thing, "reaches for " + hold.thing))
    return failure;
  auto near = checker(scene, open, {hold.thing});
  plan.stages.push_back(straight(near, approach, "approaches " + hold.thing, open));
  const double closed = arm_.gripper->narrowest;
  plan.stages.push_back(
    still(approach.back(), ManipulationStatus::grasping, "grasps " + hold.thing, closed, true));
  plan.stages.back().takes = hold.scene.held;
  auto lifting = checker(hold.scene, hold.opening, hold.supports);
  plan.stages.push_back(straight(lifting, hold.lift, "lifts " + hold.thing, closed));
  plan.stages.back().holds = true;
  plan.held = hold.scene.held;
  return {};
}

ManipulationResult ManipulationPlanner::pick(const Scene& scene, const std::string& thing,
                                             const Configuration& start) const {
  auto found = find_grasps(arm_, inverse_, scene, thing, start, options_.grasps);
  if (auto* failure = std::get_if<MotionFailure>(&found))
    return std::move(*failure);
  MotionFailure failure{MotionFailureKind::no_way,
                        {},
                        thing + " cannot be lifted: there is no "
                                "room above it"};
  std::size_t tried = 0;
  for (const auto& grasp : std::get<std::vector<Grasp>>(found)) {
    const auto held = hold(scene, thing, grasp);
    if (!held)
      continue;
    ManipulationPlan plan;
    auto why = add_pick(plan, scene, *held, start);
    if (!why)
      return plan;
    failure = *std::move(why);
    if (++tried == most_tried)
      break;
  }
  return failure;
}

/// Ways down to the places of the goal; the thing is turned there as it would be with the tool at
/// `tool`, but for turns around a vertical axis.
std::vector<ManipulationPlanner::Landing>
ManipulationPlanner::landings(const Scene& scene, const Pose& tool, const PlaceGoal& goal,
                              const Configuration& near, double opening,
                              std::vector<Contact>& contacts) const {
  const auto& held = *scene.held;
  const auto thing = geometry::compose(tool, held.pose);
  const double half = half_height(held.solid, thing.rotation);
  const Point3 offset{tool.position.x - thing.position.x, tool.position.y - thing.position.y,
                      tool.position.z - thing.position.z};
  // Straight down, any turn will do, and the one of the tool's position is as good as another.
  auto direction = geometry::rotate(tool.rotation, Point3{0, 0, 1});
  if (std::hypot(direction.x, direction.y) < 1e-6)
    direction = tool.position;
  const auto turned_tool = [&](const Point3& middle, double turn) {
    const auto rotation = geometry::rotation_about_z(turn);
    const auto shift = geometry::rotate(rotation, offset);
    return Pose{{middle.x + shift.x, middle.y + shift.y, middle.z + shift.z},
                geometry::compose(rotation, tool.rotation),
                arm_frame};
  };
  auto holding_it = checker(scene, opening, {goal.support});
  auto free = checker(scene, opening, {});
  std::vector<Landing> result;
  const auto try_at = [&](const Point3& middle, double turn) {
    const auto at = turned_tool(middle, turn);
    for (const auto& solution : inverse_.solve(at, near)) {
      if (auto contact = holding_it.contact(solution)) {
        contacts.push_back(*std::move(contact));
        continue;
      }
      std::optional<std::vector<Configuration>> down;
      for (const auto& above : ways_up(at)) {
        down = straight_motion(arm_, inverse_, holding_it, solution, above);
        if (down && free.contact(down->back()))
          down.reset();
        if (down)
          break;
      }
      if (!down)
        continue;
      std::ranges::reverse(*down);
      // Open, as on the way to a grasp.
      const double open = std::min(arm_.gripper->widest, opening + options_.grasps.spare);
      const auto there = released(scene, at);
      auto open_hand = checker(there, open, {held.name, goal.support});
      const auto& grasps = options_.grasps;
      auto away =
        way_back(arm_, inverse_, open_hand, solution, at,
                 std::array{way_out(arm_, there.things.back(), at, grasps), grasps.approach});
      if (!away)
        continue;
      result.push_back({*std::move(down), *std::move(away), there.things.back().pose});
      return true;
    }
    return false;
  };
  std::vector<Point3> places{goal.bottom};
  for (const double ring : {0.5, 1.0})
    for (int i = 0; i < options_.places && goal.radius > 0; ++i) {
      const double angle = 2 * pi * i / options_.places;
      places.push_back({goal.bottom.x + ring * goal.radius * std::cos(angle),
                        goal.bottom.y + ring * goal.radius * std::sin(angle), goal.bottom.z});
    }
  for (const auto& place : places) {
    const Point3 middle{place.x, place.y, place.z + half + options_.let_go};
    // An arm that cannot come from any direction has its tool in the plane of its turret.
    double turn = azimuth(middle) - azimuth(direction);
    for (int i = 0; i < azimuth_rounds; ++i)
      turn = azimuth(turned_tool(middle, turn).position) - azimuth(direction);
    if (try_at(middle, turn + goal.turn) || (goal.turn == 0 && try_at(middle, 0)))
      continue;
    for (int i = 1; i < 4 && !inverse_.is_closed_form(); ++i)
      if (try_at(middle, turn + pi / 2 * i))
        break;
  }
  return result;
}

MotionFailure ManipulationPlanner::no_landing(const Scene& scene, const PlaceGoal& goal,
                                              const std::vector<Contact>& contacts) const {
  if (!contacts.empty())
    return blocked_goal(contacts, goal.text);
  return {MotionFailureKind::out_of_reach,
          {},
          goal.text + " is out of reach with " + scene.held->name +
            ": the arm cannot turn its gripper so that it puts it down there"};
}

std::optional<MotionFailure>
ManipulationPlanner::add_place(ManipulationPlan& plan, const Scene& scene,
                               const std::vector<Landing>& landings, const PlaceGoal& goal,
                               const Configuration& start, double opening,
                               double released_opening) const {
  const auto thing = scene.held->name;
  std::optional<MotionFailure> failure;
  for (std::size_t i = 0; i < std::min(landings.size(), most_tried); ++i) {
    const auto& landing = landings[i];
    failure =
      move(plan, scene, start, {landing.down.front()}, opening, goal.text, "carries " + thing);
    if (failure)
      continue;
    const double closed = arm_.gripper->narrowest;
    plan.stages.back().opening = closed;
    plan.stages.back().holds = true;
    auto down = checker(scene, opening, {goal.support});
    plan.stages.push_back(straight(down, landing.down, "puts down " + thing, closed));
    plan.stages.back().holds = true;
    plan.stages.push_back(still(landing.down.back(), ManipulationStatus::releasing,
                                "lets go of " + thing, released_opening, false));
    const auto there = released(scene, tool_pose(arm_, landing.down.back()));
    auto open_hand = checker(there, released_opening, {thing, goal.support});
    plan.stages.push_back(
      straight(open_hand, landing.away, "withdraws from " + thing, released_opening));
    plan.goal = landing.goal;
    plan.held.reset();
    return {};
  }
  return failure;
}

ManipulationResult ManipulationPlanner::place(const Scene& scene, const PlaceGoal& goal,
                                              const Configuration& start) const {
  if (!scene.held)
    return MotionFailure{MotionFailureKind::no_grasp, {}, "the gripper holds nothing"};
  // On its way the thing may have been tilted.
  auto tool = tool_pose(arm_, start);
  const auto up =
    geometry::rotate(geometry::compose(tool.rotation, scene.held->pose.rotation), Point3{0, 0, 1});
  tool.rotation = geometry::compose(upright(up), tool.rotation);
  const auto across = geometry::rotate(tool.rotation, Point3{0, 1, 0});
  auto held = *scene.held;
  held.pose = geometry::compose(tool, held.pose);
  const double opening = 2 * half_extent(held, across);
  std::vector<Contact> contacts;
  const auto found = landings(scene, tool, goal, start, opening, contacts);
  if (found.empty())
    return no_landing(scene, goal, contacts);
  ManipulationPlan plan;
  const double open = std::min(arm_.gripper->widest, opening + options_.grasps.spare);
  if (auto failure = add_place(plan, scene, found, goal, start, opening, open))
    return *std::move(failure);
  return plan;
}

ManipulationPlanner::WaysToTake
ManipulationPlanner::ways_to_take(const Scene& scene, const std::string& thing,
                                  const Configuration& start) const {
  const auto found = find_grasps(arm_, inverse_, scene, thing, start, options_.grasps);
  auto holds = std::make_shared<std::vector<Hold>>();
  if (const auto* grasps = std::get_if<std::vector<Grasp>>(&found))
    for (const auto& grasp : *grasps)
      if (auto held = hold(scene, thing, grasp))
        holds->push_back(*std::move(held));
  WaysToTake result;
  result.holds_ = std::move(holds);
  return result;
}

std::optional<Pose> ManipulationPlanner::landing_of(const WaysToTake& ways,
                                                    const PlaceGoal& goal) const {
  std::vector<Contact> contacts;
  for (const auto& x : *ways.holds_)
    if (const auto found = landings(x.scene, x.tool, goal, x.lift.back(), x.opening, contacts);
        !found.empty())
      return found.front().goal;
  return {};
}

ManipulationResult ManipulationPlanner::pick_and_place(const Scene& scene, const std::string& thing,
                                                       const PlaceGoal& goal,
                                                       const Configuration& start) const {
  auto found = find_grasps(arm_, inverse_, scene, thing, start, options_.grasps);
  if (auto* failure = std::get_if<MotionFailure>(&found))
    return std::move(*failure);
  std::optional<MotionFailure> failure;
  std::optional<Hold> last;
  std::vector<Contact> contacts;
  std::size_t tried = 0;
  for (const auto& grasp : std::get<std::vector<Grasp>>(found)) {
    auto held = hold(scene, thing, grasp);
    if (!held)
      continue;
    const auto ways =
      landings(held->scene, held->tool, goal, held->lift.back(), held->opening, contacts);
    last = std::move(held);
    if (ways.empty())
      continue;
    ManipulationPlan plan;
    failure = add_pick(plan, scene, *last, start);
    if (!failure)
      failure = add_place(plan, last->scene, ways, goal, last->lift.back(), last->opening,
                          last->grasp.opening);
    if (!failure)
      return plan;
    if (++tried == most_tried)
      break;
  }
  if (failure)
    return *std::move(failure);
  if (last)
    return no_landing(last->scene, goal, contacts);
  return MotionFailure{
    MotionFailureKind::no_way, {}, thing + " cannot be lifted: there is no room above it"};
}

} // namespace castor::manipulation
