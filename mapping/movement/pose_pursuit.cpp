#include "castor/mapping/movement/pose_pursuit.hpp"

#include "castor/mapping/planar/braking.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace castor::mapping {

namespace {

Path places_of(const PosePath& path) {
  Path result{{path.start.x, path.start.y}};
  constexpr double step = 0.1; // metres
  auto begin = path.start;
  for (const auto& x : path.motions) {
    const int pieces = static_cast<int>(std::ceil(std::abs(x.forward) / step));
    for (int i = 1; i <= pieces; ++i) {
      const auto pose = pose_on(begin, x, static_cast<double>(i) / pieces);
      result.push_back({pose.x, pose.y});
    }
    begin = pose_on(begin, x, 1);
  }
  return result;
}

} // namespace

PosePursuit::PosePursuit(const Point2& goal, std::optional<double> heading,
                         const PosePursuitOptions& options)
  : goal_(goal), heading_(heading), options_(options), stall_(options.pursuit.stall) {
  options_.pursuit.movers.robot_radius = options_.footprint.outer_radius();
}

PosePursuit::Step PosePursuit::step(std::int64_t time, const Pose2& robot,
                                    const PursuitSurroundings& around) {
  if (stands_ && step_time_)
    waited_ += time - *step_time_;
  step_time_ = time_ = time;
  stands_ = false;
  if (follower_ ? follower_->has_arrived() : is_at_goal(robot))
    return finish(robot);
  if (follower_ && is_off_path(robot))
    return begin_again(robot, "it comes off every path");
  const auto period = options_.pursuit.replan_period;
  if (!follower_)
    return !planned_ || time - *planned_ >= period ? plan(robot, around)
                                                   : stand(MovementStatus::waiting, "a free way");
  if (!looked_ || time - *looked_ >= period) {
    looked_ = time;
    if (!is_path_free(around.map, unexpected_obstacles(around, options_.pursuit)))
      return plan(robot, around);
  }
  return drive(robot, around);
}

ClearanceMap PosePursuit::clearance_with(const PlanningMap& map, std::span<const Point2> obstacles,
                                         double around) const {
  auto result = map.clearance();
  const double reach = options_.footprint.outer_radius() + 2 * options_.plan.margin;
  for (const auto& x : obstacles)
    result.add_obstacle(x, reach, around);
  return result;
}

PosePursuit::Step PosePursuit::plan(const Pose2& robot, const PursuitSurroundings& around) {
  planned_ = time_;
  ++plans_;
  follower_.reset();
  const auto obstacles = unexpected_obstacles(around, options_.pursuit);
  auto planned = plan_around_all_seen(robot, around);
  if (planned.path.empty()) {
    auto clearance = clearance_with(around.map, obstacles, options_.pursuit.unexpected_margin);
    is_tight_ = FootprintRoom(clearance, options_.footprint, options_.plan.margin).at(robot) <= 0;
    if (is_tight_)
      clearance = clearance_with(around.map, obstacles, 0);
    planned = plan_with(clearance, robot, around);
  }
  if (!planned.path.empty()) {
    blocked_since_.reset();
    path_ = places_of(planned.path);
    follower_.emplace(std::move(planned.path), options_.follow);
    looked_ = time_;
    return stand(MovementStatus::planning, {});
  }
  if (obstacles.empty() && planned.is_proved)
    return {{}, MovementStatus::failed, {}, planned.reason};
  if (obstacles.empty())
    return begin_again(robot, planned.reason);
  if (!blocked_since_)
    blocked_since_ = time_;
  if (time_ - *blocked_since_ >= options_.pursuit.patience)
    return {{}, MovementStatus::failed, {}, planned.reason};
  return stand(MovementStatus::waiting, "a free way");
}

PlannedPosePath PosePursuit::plan_around_all_seen(const Pose2& robot,
                                                  const PursuitSurroundings& around) {
  if (!stuck_at_ || distance(*stuck_at_, Point2{robot.x, robot.y}) > options_.pursuit.one_place)
    return {};
  is_tight_ = true;
  return plan_with(clearance_with(around.map, around.seen, 0), robot, around);
}

PlannedPosePath PosePursuit::plan_with(const ClearanceMap& clearance, const Pose2& robot,
                                       const PursuitSurroundings& around) const {
  auto options = options_.plan;
  options.seed += static_cast<std::uint32_t>(plans_);
  return plan_poses(around.map.cells(), clearance, options_.footprint, robot, goal_, heading_,
                    options);
}

bool PosePursuit::is_at_goal(const Pose2& robot) const {
  return distance(goal_, {robot.x, robot.y}) <= options_.tolerance &&
         (!heading_ || std::abs(normalised(*heading_ - robot.heading)) <= options_.facing);
}

PosePursuit::Step PosePursuit::finish(const Pose2& robot) {
  if (is_at_goal(robot))
    return {{}, MovementStatus::arrived, {}, {}};
  return begin_again(
    robot, fmt::format("it ends {:.2f} m beside the goal", distance(goal_, {robot.x, robot.y})));
}

PosePursuit::Step PosePursuit::begin_again(const Pose2& robot, const std::string& problem) {
  const Point2 here{robot.x, robot.y};
  if (distance(here, stalled_at_) > options_.pursuit.one_place)
    recoveries_there_ = 0;
  stalled_at_ = here;
  ++recoveries_;
  if (++recoveries_there_ > options_.pursuit.recoveries)
    return {{},
            MovementStatus::failed,
            {},
            fmt::format("it is stuck at {:.2f} {:.2f}: {}, {} new plans did not help", robot.x,
                        robot.y, problem, options_.pursuit.recoveries)};
  follower_.reset();
  planned_.reset();
  return stand(MovementStatus::recovering, {});
}

bool PosePursuit::is_off_path(const Pose2& robot) const {
  const auto wrong = between(follower_->reference(), robot);
  // Turns on the spot begin with any heading.
  return std::hypot(wrong.x, wrong.y) > options_.most_aside ||
         (follower_->is_driving() && std::abs(wrong.heading) > options_.most_turned);
}

bool PosePursuit::is_path_free(const PlanningMap& map, std::span<const Point2> obstacles) const {
  // Less than planned for, or each cell that flickers would be a reason for a new plan.
  const double least = options_.plan.margin / 4;
  const FootprintRoom room(map.clearance(), options_.footprint, least);
  const auto poses = follower_->ahead(options_.pursuit.look_out, options_.footprint.outer_radius(),
                                      map.cells().cell_size);
  const double start_room = room.at(poses.front());
  for (const auto& pose : poses) {
    if (const double x = room.at(pose); x <= 0 && x < start_room)
      return false;
    const auto robot = inverse(pose);
    for (const auto& x : obstacles)
      if (distance(x, {pose.x, pose.y}) < options_.footprint.outer_radius() + least &&
          options_.footprint.distance_from(transform(robot, x)) < least)
        return false;
  }
  return true;
}

double PosePursuit::free_way(const Pose2& robot, double reach,
                             const PursuitSurroundings& around) const {
  struct Near {
    Point2 point;
    double kept = 0;
  };
  const auto& footprint = options_.footprint;
  const auto& pursuit = options_.pursuit;
  std::vector<Near> near;
  for (const auto& x : around.seen) {
    if (distance(x, {robot.x, robot.y}) > reach + footprint.outer_radius() + pursuit.unexpected_gap)
      continue;
    const bool is_near = is_tight_ || is_expected(around.map, x, pursuit);
    const double gap = is_near ? pursuit.gap : pursuit.unexpected_gap;
    // What is nearer already may come a little nearer, and where it is very near, no more.
    constexpr double little = 0.01; // metres
    constexpr double rounding = 0.001;
    const double now = footprint.distance_from(transform(inverse(robot), x));
    const double nearer = now - little > pursuit.gap ? little : rounding;
    near.push_back({x, std::min(gap, now - nearer)});
  }
  constexpr double step = 0.02; // metres
  // It keeps the error that it has.
  const auto error = between(follower_->reference(), robot);
  double way = 0;
  for (const auto& reference : follower_->ahead(reach, footprint.outer_radius(), step)) {
    const auto then = inverse(compose(reference, error));
    for (const auto& x : near)
      if (footprint.distance_from(transform(then, x.point)) < x.kept)
        return std::max(0.0, way - step);
    way += step;
  }
  return reach;
}

double PosePursuit::permitted_share(const Pose2& robot, const Twist2& wanted,
                                    const PursuitSurroundings& around) const {
  const auto& pursuit = options_.pursuit;
  // Of the outermost point.
  const double fast =
    std::abs(wanted.forward) + options_.footprint.outer_radius() * std::abs(wanted.turn);
  if (fast == 0)
    return 1;
  const double reach = fast * fast / (2 * pursuit.braking) + fast * pursuit.reaction + 0.1;
  const double left = free_way(robot, reach, around);
  double result = 1;
  if (left < reach)
    result = std::min(1.0, speed_to_stop_within(left, pursuit.reaction, pursuit.braking) / fast);
  if (wanted.forward == 0)
    return result;
  const FootprintRoom room(around.map.clearance_of_occupied(), options_.footprint, 0);
  const double most =
    place_speed({robot.x, robot.y}, room.at(robot) < options_.narrow_room, around, pursuit);
  result = std::min(result, most / std::abs(wanted.forward));
  return std::min(result, share_among_movers(robot, wanted, around.movers, pursuit.movers));
}

PosePursuit::Step PosePursuit::drive(const Pose2& robot, const PursuitSurroundings& around) {
  const auto wanted = follower_->velocity_at(robot);
  if (follower_->has_arrived())
    return finish(robot);
  const double share = permitted_share(robot, wanted, around);
  constexpr double least = 0.05;
  const bool stops = share < least;
  if (stall_.has_stalled(time_, robot, !stops || around.movers.empty())) {
    stuck_at_ = {robot.x, robot.y};
    return begin_again(robot, "it does not come further");
  }
  if (stops)
    return stand(MovementStatus::waiting,
                 around.movers.empty() ? "a free way" : "somebody to pass");
  return {{share * wanted.forward, share * wanted.turn}, MovementStatus::moving, {}, {}};
}

PosePursuit::Step PosePursuit::stand(MovementStatus status, const std::string& waits_for) {
  stands_ = true;
  return {{}, status, waits_for, {}};
}

} // namespace castor::mapping
