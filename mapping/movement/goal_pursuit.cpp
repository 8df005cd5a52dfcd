#include "castor/mapping/movement/goal_pursuit.hpp"

#include "castor/mapping/movement/free_arc.hpp"
#include "castor/mapping/planar/braking.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace castor::mapping {

namespace {

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
  : goal_(goal), heading_(heading), options_(options) {}

GoalPursuit::Step GoalPursuit::step(std::int64_t time, const Pose2& robot, const PlanningMap& map,
                                    std::span<const Point2> seen) {
  const auto since_last = step_time_ ? time - *step_time_ : 0;
  step_time_ = time_ = time;
  if (stands_since_ || is_blocked_)
    waited_ += since_last;
  if (backs_off_from_)
    return recover(robot, map, seen);
  if (follower_ && follower_->has_arrived())
    return turn_at_goal(robot);
  const bool may_plan = !planned_ || time - *planned_ >= options_.replan_period;
  const auto obstacles = unexpected(map, seen);
  if (may_plan && (!follower_ || is_blocked_ || !is_path_free(robot, map, obstacles)))
    plan(robot, map, obstacles);
  if (!problem_.empty())
    return fail(problem_);
  if (!is_blocked_) {
    blocked_since_.reset();
    return drive(robot, map, seen);
  }
  if (!blocked_since_)
    blocked_since_ = time;
  if (time - *blocked_since_ >= options_.patience)
    return fail(fmt::format("something that is not on the map blocks every way, for {} s by now",
                            options_.patience / 1'000'000));
  return stand(MovementStatus::waiting, "a free way");
}

std::vector<Point2> GoalPursuit::unexpected(const PlanningMap& map,
                                            std::span<const Point2> seen) const {
  std::vector<Point2> result;
  for (auto& x : seen)
    if (map.clearance_of_occupied().at(x) > options_.unexpected_from)
      result.push_back(x);
  return result;
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

void GoalPursuit::plan(const Pose2& robot, const PlanningMap& map,
                       std::span<const Point2> obstacles) {
  planned_ = time_;
  ++plans_;
  const Point2 start{robot.x, robot.y};
  PlannedPath planned;
  if (!obstacles.empty()) {
    auto options = options_.plan;
    options.explains = false;
    auto clearance = map.clearance();
    for (auto& x : obstacles)
      clearance.add_obstacle(x, options.preferred_clearance);
    planned = plan_path(map.cells(), clearance, start, goal_, options);
  }
  is_blocked_ = false;
  if (planned.points.empty()) {
    planned = plan_path(map.cells(), map.clearance(), start, goal_, options_.plan);
    if (planned.points.empty()) {
      problem_ = planned.reason;
      return;
    }
    is_blocked_ = !obstacles.empty();
  }
  if (is_blocked_)
    return;
  path_ = std::move(planned.points);
  follower_ = std::make_unique<PathFollower>(path_, options_.follow);
}

GoalPursuit::Step GoalPursuit::stand(MovementStatus status, const std::string& waits_for) {
  return {{}, status, waits_for, {}};
}

GoalPursuit::Step GoalPursuit::drive(const Pose2& robot, const PlanningMap& map,
                                     std::span<const Point2> seen) {
  auto velocity = follower_->velocity_at(robot);
  if (follower_->has_arrived())
    return turn_at_goal(robot);
  auto slow_to = [&](double fastest) {
    if (velocity.forward > fastest) {
      velocity.turn *= fastest / velocity.forward;
      velocity.forward = fastest;
    }
  };
  if (map.clearance_of_occupied().at(Point2{robot.x, robot.y}) < options_.narrow_clearance)
    slow_to(options_.narrow_speed);
  if (velocity.forward > 0) {
    const double fast = velocity.forward;
    const double reach = fast * fast / (2 * options_.braking) + fast * options_.reaction + 0.1;
    const double left = free_arc(robot, velocity, seen, options_.plan.radius, options_.gap, reach);
    if (left < reach) {
      const double fastest = speed_to_stop_within(left, options_.reaction, options_.braking);
      constexpr double slowest = 0.03; // m/s
      if (fastest < slowest) {
        if (!stands_since_)
          stands_since_ = time_;
        if (time_ - *stands_since_ >= options_.stall_time) {
          stands_since_.reset();
          if (++recoveries_ > options_.recoveries)
            return fail(fmt::format("it is stuck at {:.2f} {:.2f}: {} recoveries did not help",
                                    robot.x, robot.y, options_.recoveries));
          backs_off_from_ = robot;
          return recover(robot, map, seen);
        }
        return stand(MovementStatus::waiting, "a free way");
      }
      slow_to(fastest);
    }
  }
  stands_since_.reset();
  return {velocity, MovementStatus::moving, {}, {}};
}

GoalPursuit::Step GoalPursuit::recover(const Pose2& robot, const PlanningMap& map,
                                       std::span<const Point2> seen) {
  const Twist2 back{-options_.back_off_speed, 0};
  const double step = 0.05; // metres
  const auto behind = transform(robot, Point2{-step, 0});
  const bool is_map_free =
    map.clearance().at(behind) >=
    std::min(options_.plan.radius + options_.gap, map.clearance().at(Point2{robot.x, robot.y}));
  const bool is_free =
    free_arc(robot, back, seen, options_.plan.radius, options_.gap, step) >= step - 1e-9;
  if (distance(robot, *backs_off_from_) < options_.back_off && is_map_free && is_free)
    return {back, MovementStatus::recovering, {}, {}};
  backs_off_from_.reset();
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
