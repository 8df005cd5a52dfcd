#include "castor/mapping/movement/goal_pursuit.hpp"

#include "castor/mapping/movement/free_arc.hpp"
#include "castor/mapping/planar/braking.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace castor::mapping {

namespace {

/// What is slower stands, m/s.
constexpr double slowest = 0.03;

double distance_from_piece(const Point2& p, const Point2& a, const Point2& b) {
  const double dx = b.x - a.x;
  const double dy = b.y - a.y;
  const double squared = dx * dx + dy * dy;
  const double share =
    squared > 0 ? std::clamp(((p.x - a.x) * dx + (p.y - a.y) * dy) / squared, 0.0, 1.0) : 0;
  return distance(p, Point2{a.x + share * dx, a.y + share * dy});
}

} // namespace

GoalPursuit::GoalPursuit(const Point2& goal, std::optional<double> heading,
                         const PursuitOptions& options)
  : goal_(goal), heading_(heading), options_(options), recovery_(options.stall) {
  options_.movers.robot_radius = options_.plan.radius;
}

GoalPursuit::Step GoalPursuit::step(std::int64_t time, const Pose2& robot,
                                    const PursuitSurroundings& around) {
  if (stands_ && step_time_)
    waited_ += time - *step_time_;
  step_time_ = time_ = time;
  stands_ = false;
  if (recovery_.is_active())
    return recover(robot, around);
  const bool may_plan = !planned_ || time - *planned_ >= options_.replan_period;
  if (follower_ && follower_->has_arrived() && !(is_goal_new_ && may_plan))
    return turn_at_goal(robot);
  const auto in_the_way = unexpected_obstacles(around, options_);
  if (may_plan &&
      (!follower_ || is_blocked_ || is_goal_new_ || !is_path_free(robot, around.map, in_the_way)))
    plan(robot, around.map, in_the_way);
  if (!problem_.empty())
    return fail(problem_);
  if (!comes_nearer())
    return fail(fmt::format("it has not come nearer for {} s, among what is in its way",
                            options_.longest / 1'000'000));
  if (!is_blocked_) {
    blocked_since_.reset();
    return drive(robot, around, in_the_way);
  }
  if (!blocked_since_)
    blocked_since_ = time;
  if (time - *blocked_since_ >= options_.patience)
    return fail(fmt::format("something that is not on the map blocks every way, for {} s by now",
                            options_.patience / 1'000'000));
  return stand(MovementStatus::waiting, "a free way");
}

bool GoalPursuit::comes_nearer() {
  constexpr double further = 0.25; // metres
  if (follower_) {
    const double left = follower_->length() - follower_->done();
    if (!least_left_ || left < *least_left_ - further) {
      least_left_ = left;
      nearer_at_ = time_;
    }
  }
  return !least_left_ || time_ - nearer_at_ < options_.longest;
}

void GoalPursuit::change_goal(const Point2& goal) {
  if (goal == goal_)
    return;
  least_left_.reset();
  goal_ = goal;
  is_goal_new_ = true;
}

void GoalPursuit::hold(std::int64_t time, const Pose2& robot) {
  time_ = time;
  step_time_.reset();
  blocked_since_.reset();
  least_left_.reset();
  recovery_.has_stalled(time, robot, false);
}

bool GoalPursuit::is_path_free(const Pose2& robot, const PlanningMap& map,
                               std::span<const Point2> points) const {
  // Less than planned for, or each cell that flickers would be a reason for a new plan.
  const double least = options_.plan.radius + options_.plan.margin / 2;
  const double done = follower_->done();
  double way = 0;
  for (std::size_t i = 1; i < path_.size(); ++i) {
    const double piece = distance(path_[i - 1], path_[i]);
    const double begin = std::max(0.0, done - way);
    const double end = std::min(piece, done + options_.look_out - way);
    way += piece;
    if (!(begin < end) || !(piece > 0))
      continue;
    auto at = [&](double x) {
      return Point2{std::lerp(path_[i - 1].x, path_[i].x, x / piece),
                    std::lerp(path_[i - 1].y, path_[i].y, x / piece)};
    };
    const auto a = at(begin);
    const auto b = at(end);
    const bool leaves_start = distance(a, {robot.x, robot.y}) < options_.plan.start_tolerance;
    if (!leaves_start && !is_clear(map.clearance(), a, b, least - map.cells().cell_size))
      return false;
    for (auto& x : points)
      if (distance_from_piece(x, a, b) < least)
        return false;
  }
  return true;
}

PlannedPath GoalPursuit::plan_around(const Point2& start, const PlanningMap& map,
                                     std::span<const Point2> obstacles) const {
  auto options = options_.plan;
  options.explains = false;
  auto clearance = map.clearance();
  for (auto& x : obstacles)
    clearance.add_obstacle(x, options.preferred_clearance, options_.unexpected_margin);
  return plan_path(map.cells(), clearance, start, goal_, options);
}

bool GoalPursuit::is_worth_waiting(const PlannedPath& around, const Point2& start,
                                   const PlanningMap& map) const {
  if (blocked_since_ && time_ - *blocked_since_ >= options_.detour_patience)
    return false;
  if (follower_)
    return around.length > follower_->length() - follower_->done() + options_.detour;
  if (!options_.passing)
    return false;
  auto options = options_.plan;
  options.explains = false;
  const auto direct = plan_path(map.cells(), map.clearance(), start, goal_, options);
  return !direct.points.empty() && around.length > direct.length + options_.detour;
}

void GoalPursuit::plan(const Pose2& robot, const PlanningMap& map,
                       std::span<const Point2> obstacles) {
  planned_ = time_;
  ++plans_;
  // The new path begins where the robot is.
  const double aside = follower_ ? follower_->aside(robot) : 0;
  // The length of a way to another goal is no reason to wait for that one.
  if (std::exchange(is_goal_new_, false))
    follower_.reset();
  const Point2 start{robot.x, robot.y};
  PlannedPath planned;
  if (!obstacles.empty())
    planned = plan_around(start, map, obstacles);
  is_blocked_ = false;
  if (planned.points.empty()) {
    planned = plan_path(map.cells(), map.clearance(), start, goal_, options_.plan);
    if (planned.points.empty()) {
      problem_ = planned.reason;
      return;
    }
    is_blocked_ = !obstacles.empty();
  } else {
    is_blocked_ = is_worth_waiting(planned, start, map);
  }
  if (is_blocked_)
    return;
  shift_ -= aside;
  path_ = std::move(planned.points);
  auto follow = options_.follow;
  // Where it was stuck it cuts no corners.
  if (recoveries_there_ > 0 && distance(start, stalled_at_) <= options_.one_place)
    follow.look_ahead = std::min(follow.look_ahead, options_.careful_look_ahead);
  follower_ = std::make_unique<PathFollower>(path_, follow);
}

GoalPursuit::Step GoalPursuit::stand(MovementStatus status, const std::string& waits_for) {
  stands_ = true;
  return {{}, status, waits_for, {}};
}

double GoalPursuit::speed_before(const Pose2& robot, const Twist2& wanted,
                                 const PursuitSurroundings& around) const {
  const double fast = std::abs(wanted.forward);
  const double reach = fast * fast / (2 * options_.braking) + fast * options_.reaction + 0.1;
  std::vector<Point2> expected;
  std::vector<Point2> unexpected;
  for (auto& x : around.seen)
    if (distance(x, {robot.x, robot.y}) < reach + 2 * options_.plan.radius)
      (is_expected(around.map, x, options_) ? expected : unexpected).push_back(x);
  const auto way = [&](const std::vector<Point2>& points, double gap) {
    return free_arc(robot, wanted, points, options_.plan.radius, gap, reach);
  };
  const double left =
    std::min(way(expected, options_.gap), way(unexpected, options_.unexpected_gap));
  return left < reach ? speed_to_stop_within(left, options_.reaction, options_.braking) : fast;
}

double GoalPursuit::speed_here(const Pose2& robot, const PursuitSurroundings& around) const {
  const Point2 here{robot.x, robot.y};
  const bool is_narrow = around.map.clearance_of_occupied().at(here) < options_.narrow_clearance;
  return std::min(
    {options_.follow.speed, most_speed_, place_speed(here, is_narrow, around, options_)});
}

Twist2 GoalPursuit::limited(const Pose2& robot, const Twist2& wanted,
                            const PursuitSurroundings& around) const {
  if (!(wanted.forward > 0))
    return wanted;
  auto result = wanted;
  result.forward =
    std::min({wanted.forward, speed_here(robot, around), speed_before(robot, wanted, around)});
  result.turn *= result.forward / wanted.forward;
  const double share = share_among_movers(robot, result, around.movers, options_.movers);
  result.turn *= share;
  result.forward *= share;
  return result;
}

std::optional<Passing> GoalPursuit::passing(const Pose2& robot, const PursuitSurroundings& around,
                                            std::span<const Point2> in_the_way) const {
  const double fastest = speed_here(robot, around);
  if (around.movers.empty())
    return Passing{0, fastest};
  const Point2 here{robot.x, robot.y};
  std::vector<Point2> obstacles;
  for (const auto& x : in_the_way)
    if (distance(x, here) < fastest * options_.movers.horizon + 1)
      obstacles.push_back(x);
  const auto& clearance = around.map.clearance();
  const double room = clearance.between_cells(here);
  const auto is_free = [&](const Point2& place) {
    const double there = clearance.between_cells(place);
    return (there >= options_.plan.radius + options_.gap || there >= room) &&
           std::ranges::none_of(obstacles, [&](const Point2& x) {
             const double away = distance(x, place);
             return away < options_.plan.radius + options_.unexpected_gap &&
                    away < distance(x, here);
           });
  };
  return choose_passing(*follower_, robot, shift_, fastest, around.movers, options_.movers, is_free,
                        *options_.passing);
}

GoalPursuit::Motion GoalPursuit::along_path(const Pose2& robot, const PursuitSurroundings& around) {
  const auto wanted = follower_->velocity_at(robot);
  const auto velocity = limited(robot, wanted, around);
  const bool stops = wanted.forward > 0 && velocity.forward < slowest;
  return {wanted, velocity,
          stops && speed_before(robot, wanted, around) >= slowest && !around.movers.empty()};
}

GoalPursuit::Motion GoalPursuit::beside_path(const Pose2& robot, const PursuitSurroundings& around,
                                             std::span<const Point2> in_the_way) {
  const auto passing = this->passing(robot, around, in_the_way);
  if (passing)
    shift_ = passing->shift;
  const auto wanted = velocity_aside(*follower_, robot, shift_, *options_.passing);
  if (!(wanted.forward > 0))
    return {wanted, wanted, false};
  auto velocity = wanted;
  const double most = passing ? passing->speed : 0;
  velocity.forward = std::min({wanted.forward, most, speed_before(robot, wanted, around)});
  velocity.turn *= velocity.forward / wanted.forward;
  return {wanted, velocity, !passing};
}

GoalPursuit::Step GoalPursuit::drive(const Pose2& robot, const PursuitSurroundings& around,
                                     std::span<const Point2> in_the_way) {
  const auto motion =
    options_.passing ? beside_path(robot, around, in_the_way) : along_path(robot, around);
  if (follower_->has_arrived())
    return turn_at_goal(robot);
  if (!motion.waits_for_mover)
    waits_since_.reset();
  else if (!waits_since_)
    waits_since_ = time_;
  const bool may_wait =
    waits_since_ && (!options_.passing || time_ - *waits_since_ < options_.passing->patience);
  if (recovery_.has_stalled(time_, robot, !may_wait)) {
    ++recoveries_;
    return motion.waits_for_mover ? go_back(robot, around) : begin_recovery(robot, around);
  }
  if (motion.waits_for_mover)
    return stand(MovementStatus::waiting, "somebody to pass");
  constexpr double turning = 0.1; // rad/s
  const bool stops = motion.wanted.forward > 0 && motion.velocity.forward < slowest;
  if (stops && std::abs(motion.wanted.turn) > turning)
    return {{0, motion.wanted.turn}, MovementStatus::moving, {}, {}};
  if (stops)
    return stand(MovementStatus::waiting, "a free way");
  return {motion.velocity, MovementStatus::moving, {}, {}};
}

GoalPursuit::Step GoalPursuit::begin_recovery(const Pose2& robot,
                                              const PursuitSurroundings& around) {
  const Point2 here{robot.x, robot.y};
  if (distance(here, stalled_at_) > options_.one_place)
    recoveries_there_ = 0;
  stalled_at_ = here;
  if (++recoveries_there_ > options_.recoveries)
    return fail(fmt::format("it is stuck at {:.2f} {:.2f}: {} recoveries did not help", robot.x,
                            robot.y, options_.recoveries));
  return go_back(robot, around);
}

GoalPursuit::Step GoalPursuit::go_back(const Pose2& robot, const PursuitSurroundings& around) {
  if (recovery_.begin(time_, robot))
    return recover(robot, around);
  planned_.reset();
  follower_.reset();
  return stand(MovementStatus::recovering, {});
}

GoalPursuit::Step GoalPursuit::recover(const Pose2& robot, const PursuitSurroundings& around) {
  if (const auto back = recovery_.velocity(time_, robot))
    return {limited(robot, *back, around), MovementStatus::recovering, {}, {}};
  follower_.reset();
  planned_.reset();
  return stand(MovementStatus::recovering, {});
}

GoalPursuit::Step GoalPursuit::turn_at_goal(const Pose2& robot) const {
  constexpr double close = 0.05; // radians
  if (!heading_)
    return {{}, MovementStatus::arrived, {}, {}};
  const double left = normalised(*heading_ - robot.heading);
  if (std::abs(left) < close)
    return {{}, MovementStatus::arrived, {}, {}};
  const double most = options_.follow.max_turn;
  return {{0, std::clamp(2 * left, -most, most)}, MovementStatus::moving, {}, {}};
}

GoalPursuit::Step GoalPursuit::fail(const std::string& reason) const {
  return {{}, MovementStatus::failed, {}, reason};
}

} // namespace castor::mapping
