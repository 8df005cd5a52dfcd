#include "castor/mapping/movement/person_follower.hpp"

#include "castor/mapping/movement/free_arc.hpp"
#include "castor/mapping/movement/path_planner.hpp"
#include "castor/mapping/planar/braking.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace castor::mapping {

namespace {

/// Between points of the trail, metres, and their number.
constexpr double trail_step = 0.1;
constexpr std::size_t longest_trail = 100;
/// Somebody out of sight for so long is looked for, microseconds.
constexpr std::int64_t out_of_sight = 500'000;
/// What the laser sees so near to a person is the person; and so are other trackers' people.
/// Metres.
constexpr double person_size = 0.5;
/// Slower people stand, m/s.
constexpr double walking = 0.15;
/// m/s.
constexpr double slowest = 0.03;

Point2 place_of(const Pose2& x) {
  return {x.x, x.y};
}

double direction(const Point2& from, const Point2& to) {
  return std::atan2(to.y - from.y, to.x - from.x);
}

} // namespace

PursuitOptions pursuit_behind_person(const FollowPersonOptions& options) {
  auto result = options.pursuit;
  result.follow.speed = options.speed;
  result.narrow_speed = options.narrow_speed;
  result.patience = options.patience;
  result.passing = options.passing;
  result.unexpected_gap = std::max(result.unexpected_gap, options.unexpected_gap);
  result.unexpected_margin = std::max(result.unexpected_margin, options.unexpected_margin);
  return result;
}

PersonFollower::PersonFollower(std::int64_t person, const FollowPersonOptions& options)
  : options_(options), person_(person, options.person) {
  options_.pursuit = pursuit_behind_person(options);
}

PersonFollower::Step PersonFollower::step(std::int64_t time, const Pose2& robot,
                                          std::span<const SeenPerson> people,
                                          const PursuitSurroundings& around) {
  time_ = time;
  if (!begun_)
    begun_ = time;
  if (const auto x = person_.find(people, time))
    note(*x);
  if (!last_)
    return time - *begun_ < options_.patience
             ? Step{{}, MovementStatus::waiting, "the person", {}}
             : fail(fmt::format("person {} was not in sight for {} s", person_.id(),
                                options_.patience / 1'000'000));
  if (time - seen_time_ <= out_of_sight)
    return follow(robot, around);
  if (time - seen_time_ >= options_.patience)
    return fail(fmt::format("the person has been out of sight for {} s, last seen at {:.2f} {:.2f}",
                            options_.patience / 1'000'000, last_->place.x, last_->place.y));
  return search(robot, around);
}

void PersonFollower::note(const SeenPerson& x) {
  seen_time_ = time_;
  last_ = x;
  has_looked_beyond_ = false;
  // The newest place is the end of the trail.
  if (trail_.size() > 1 && distance(trail_[trail_.size() - 2], x.place) < trail_step)
    trail_.back() = x.place;
  else
    trail_.push_back(x.place);
  if (trail_.size() > longest_trail)
    trail_.pop_front();
}

bool PersonFollower::fits(const Point2& place, const PlanningMap& map) const {
  const auto& plan = options_.pursuit.plan;
  return map.clearance().at(place) >= plan.radius + plan.margin;
}

std::optional<Point2> PersonFollower::goal_on_trail(const PlanningMap& map) const {
  const auto newest =
    std::find_if(trail_.rbegin(), trail_.rend(), [&](const Point2& x) { return fits(x, map); });
  return newest == trail_.rend() ? std::nullopt : std::optional{*newest};
}

double PersonFollower::speed_behind(const Pose2& robot, const PlanningMap& map) {
  const auto here = place_of(robot);
  const auto& person = last_->place;
  way_ = distance(here, person);
  auto from = here;
  constexpr double sight = 0.05; // metres
  if (pursuit_ && pursuit_->length() > 0 &&
      !is_clear(map.clearance_of_occupied(), here, person, sight)) {
    const auto& path = pursuit_->path();
    way_ = pursuit_->length() - pursuit_->done() + distance(path.back(), person);
    from = path[path.size() - 2];
  }
  // As fast as the person walks away, and faster the farther that one is.
  const double away = std::cos(last_->heading - direction(from, person));
  const double along = last_->speed > walking ? last_->speed * std::max(0.0, away) : 0;
  return std::min(options_.speed, along + options_.gain * (way_ - options_.distance));
}

double PersonFollower::speed_before(const Pose2& robot, const Twist2& wanted,
                                    std::span<const Point2> points) const {
  const auto& pursuit = options_.pursuit;
  const double fast = wanted.forward;
  if (!(fast > 0))
    return fast;
  const double reach = fast * fast / (2 * pursuit.braking) + fast * pursuit.reaction;
  const double left = free_arc(robot, wanted, points, pursuit.plan.radius, pursuit.gap, reach);
  return left < reach ? speed_to_stop_within(left, pursuit.reaction, pursuit.braking) : fast;
}

PersonFollower::Step PersonFollower::follow(const Pose2& robot, const PursuitSurroundings& around) {
  const auto here = place_of(robot);
  if (distance(here, last_->place) < options_.nearest ||
      speed_behind(robot, around.map) < slowest) {
    failure_.reset();
    return turn_towards(robot, last_->place, "the person to walk on");
  }
  const auto goal = goal_on_trail(around.map);
  if (!goal)
    return wait_for_way(robot, "the robot does not fit anywhere on the person's way");
  std::vector<Point2> seen;
  std::vector<Point2> of_person;
  for (const auto& x : around.seen)
    (distance(x, last_->place) < person_size ? of_person : seen).push_back(x);
  std::vector<Mover> movers;
  for (const auto& x : around.movers)
    if (distance(x.place, last_->place) >= person_size)
      movers.push_back(x);
  auto result = pursue(robot, *goal, {around.map, seen, movers, around.gateways});
  if (result.status == MovementStatus::arrived)
    return turn_towards(robot, last_->place, "the person to walk on");
  // The path may be new.
  const double most = std::min(std::max(slowest, speed_behind(robot, around.map)),
                               speed_before(robot, result.velocity, of_person));
  if (result.status == MovementStatus::moving && result.velocity.forward > most) {
    result.velocity.turn *= most / result.velocity.forward;
    result.velocity.forward = most;
  }
  return result;
}

PersonFollower::Step PersonFollower::search(const Pose2& robot, const PursuitSurroundings& around) {
  if (const auto goal = goal_on_trail(around.map)) {
    auto result = pursue(robot, *goal, around);
    if (result.status == MovementStatus::moving)
      result.status = MovementStatus::recovering;
    if (result.status != MovementStatus::arrived)
      return result;
  }
  if (!has_looked_beyond_) {
    has_looked_beyond_ = true;
    const Point2 next{last_->place.x + options_.beyond * std::cos(last_->heading),
                      last_->place.y + options_.beyond * std::sin(last_->heading)};
    if (fits(next, around.map))
      trail_.push_back(next);
  }
  // All around.
  if (pursuit_)
    pursuit_->hold(time_, robot);
  return {{0, options_.pursuit.follow.max_turn / 2}, MovementStatus::recovering, {}, {}};
}

PersonFollower::Step PersonFollower::pursue(const Pose2& robot, const Point2& goal,
                                            const PursuitSurroundings& around) {
  if (!pursuit_ && failure_ && time_ - failed_last_ < options_.pursuit.replan_period)
    return wait_for_way(robot, {});
  if (!pursuit_)
    pursuit_.emplace(goal, std::nullopt, options_.pursuit);
  pursuit_->change_goal(goal);
  const bool is_in_sight = time_ - seen_time_ <= out_of_sight;
  pursuit_->limit_speed(is_in_sight ? std::max(slowest, speed_behind(robot, around.map))
                                    : options_.speed);
  auto result = pursuit_->step(time_, robot, around);
  if (result.status != MovementStatus::failed)
    return result;
  pursuit_.reset();
  return wait_for_way(robot, result.reason);
}

PersonFollower::Step PersonFollower::wait_for_way(const Pose2& robot, const std::string& reason) {
  const auto here = place_of(robot);
  if (!reason.empty())
    failed_last_ = time_;
  if (!failure_ || distance(failure_->place, here) > options_.pursuit.one_place)
    failure_ = Failure{time_, here};
  if (!reason.empty() && time_ - failure_->time >= options_.patience)
    return fail(fmt::format("the person could not be reached from {:.2f} {:.2f} for {} s: {}",
                            robot.x, robot.y, options_.patience / 1'000'000, reason));
  return {{}, MovementStatus::waiting, "a way to the person", {}};
}

PersonFollower::Step PersonFollower::turn_towards(const Pose2& robot, const Point2& place,
                                                  const std::string& waits_for) {
  if (pursuit_)
    pursuit_->hold(time_, robot);
  const double aside = normalised(direction(place_of(robot), place) - robot.heading);
  const double most = options_.pursuit.follow.max_turn;
  constexpr double enough = 0.1; // radians
  const double turn = std::abs(aside) < enough ? 0 : std::clamp(1.5 * aside, -most, most);
  return {{0, turn}, MovementStatus::waiting, waits_for, {}};
}

PersonFollower::Step PersonFollower::fail(const std::string& reason) const {
  return {{}, MovementStatus::failed, {}, reason};
}

} // namespace castor::mapping
