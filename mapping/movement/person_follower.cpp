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

/// Between points of the trail, metres.
constexpr double trail_step = 0.1;
/// The robot may be so far ahead on the trail, metres.
constexpr double trail_window = 1.5;
/// Somebody out of sight for so long is looked for, microseconds.
constexpr std::int64_t out_of_sight = 500'000;
/// What the laser sees so near to a person is the person, metres.
constexpr double person_size = 0.5;
/// Slower people stand, m/s.
constexpr double walking = 0.15;
/// A goal farther aside is turned to on the spot, until it is nearly ahead; radians.
constexpr double begin_to_turn = 1.0;
constexpr double end_to_turn = 0.4;
/// m/s.
constexpr double slowest = 0.03;

Point2 place_of(const Pose2& x) {
  return {x.x, x.y};
}

double direction_to(const Pose2& robot, const Point2& goal) {
  const auto seen = transform(inverse(robot), goal);
  return std::atan2(seen.y, seen.x);
}

} // namespace

PersonFollower::Step PersonFollower::step(std::int64_t time, const Pose2& robot,
                                          std::span<const SeenPerson> people,
                                          const ClearanceMap& map, std::span<const Point2> seen) {
  if (begun_ < 0)
    begun_ = seen_time_ = time_ = time;
  dt_ = static_cast<double>(time - time_) * 1e-6;
  time_ = time;
  if (const auto x = person_.find(people, time))
    note(*x);
  if (!last_)
    return time - begun_ < options_.patience
             ? turn_to(0, MovementStatus::waiting, "the person")
             : fail(fmt::format("person {} was not in sight for {} s", person_.id(),
                                options_.patience / 1'000'000));
  pass_trail(robot);
  if (blocked_since_ && time - *blocked_since_ >= options_.patience)
    return fail(fmt::format("something has been in the way at {:.2f} {:.2f} for {} s", robot.x,
                            robot.y, options_.patience / 1'000'000));
  if (time - seen_time_ <= out_of_sight)
    return follow(robot, map, seen);
  if (time - seen_time_ >= options_.patience)
    return fail(fmt::format("the person has been out of sight for {} s, last seen at {:.2f} {:.2f}",
                            options_.patience / 1'000'000, last_->place.x, last_->place.y));
  return search(robot, map, seen);
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
}

void PersonFollower::pass_trail(const Pose2& robot) {
  std::size_t nearest = 0;
  double way = 0;
  for (std::size_t i = 1; i < trail_.size(); ++i) {
    way += distance(trail_[i - 1], trail_[i]);
    if (way > trail_window)
      break;
    if (distance(trail_[i], place_of(robot)) <= distance(trail_[nearest], place_of(robot)))
      nearest = i;
  }
  trail_.erase(trail_.begin(), trail_.begin() + static_cast<std::ptrdiff_t>(nearest));
}

bool PersonFollower::is_free(const Point2& a, const Point2& b, const ClearanceMap& map,
                             std::span<const Point2> seen) const {
  const double least = options_.radius + options_.margin;
  const double length = distance(a, b);
  // The person stands at the end.
  const double until = std::max(0.0, length - person_size);
  const auto at = [&](double way) {
    const double share = length > 0 ? way / length : 0;
    return Point2{std::lerp(a.x, b.x, share), std::lerp(a.y, b.y, share)};
  };
  if (map.columns() > 0 && !is_clear(map, a, at(until), least))
    return false;
  const double step = least / 2;
  return std::ranges::none_of(seen, [&](const Point2& x) {
    if (distance(x, last_->place) < person_size)
      return false;
    for (double way = 0; way < until; way += step)
      if (distance(at(way), x) < least)
        return true;
    return false;
  });
}

std::size_t PersonFollower::aim(const Pose2& robot, const ClearanceMap& map,
                                std::span<const Point2> seen) const {
  for (std::size_t i = trail_.size(); i-- > 1;)
    if (is_free(place_of(robot), trail_[i], map, seen))
      return i;
  return 0;
}

Point2 PersonFollower::carrot(const Pose2& robot, std::size_t aimed) const {
  auto i = aimed;
  while (i + 1 < trail_.size() && distance(trail_[i], place_of(robot)) < options_.look_ahead)
    ++i;
  return trail_[i];
}

double PersonFollower::way_along(const Pose2& robot, std::size_t from) const {
  double result = distance(place_of(robot), trail_[from]);
  for (std::size_t i = from + 1; i < trail_.size(); ++i)
    result += distance(trail_[i - 1], trail_[i]);
  return result;
}

PersonFollower::Step PersonFollower::follow(const Pose2& robot, const ClearanceMap& map,
                                            std::span<const Point2> seen) {
  const auto aimed = aim(robot, map, seen);
  way_ = way_along(robot, aimed);
  const double missing = way_ - options_.distance;
  // As fast as the person walks away, and faster the farther that one is.
  const double away =
    std::cos(last_->heading - std::atan2(last_->place.y - robot.y, last_->place.x - robot.x));
  const double along = last_->speed > walking ? last_->speed * std::max(0.0, away) : 0;
  const double speed = std::min(options_.speed, along + options_.gain * missing);
  const bool is_near = distance(place_of(robot), last_->place) < options_.nearest;
  if (speed < slowest || is_near)
    return turn_to(direction_to(robot, last_->place), MovementStatus::waiting,
                   "the person to walk on");
  return drive_to(robot, carrot(robot, aimed), speed, seen);
}

PersonFollower::Step PersonFollower::search(const Pose2& robot, const ClearanceMap& map,
                                            std::span<const Point2> seen) {
  const auto aimed = aim(robot, map, seen);
  way_ = way_along(robot, aimed);
  constexpr double arrived = 0.25; // metres
  if (way_ > arrived) {
    auto result = drive_to(robot, carrot(robot, aimed),
                           std::min(options_.speed, 0.1 + options_.gain * way_), seen);
    if (result.status == MovementStatus::moving)
      result.status = MovementStatus::recovering;
    return result;
  }
  if (!has_looked_beyond_) {
    has_looked_beyond_ = true;
    const Point2 next{last_->place.x + options_.beyond * std::cos(last_->heading),
                      last_->place.y + options_.beyond * std::sin(last_->heading)};
    if (is_free(place_of(robot), next, map, seen))
      trail_.push_back(next);
  }
  // All around.
  speed_ = 0;
  return {{0, options_.max_turn / 2}, MovementStatus::recovering, {}, {}};
}

PersonFollower::Step PersonFollower::drive_to(const Pose2& robot, const Point2& goal, double speed,
                                              std::span<const Point2> seen) {
  const auto ahead = transform(inverse(robot), goal);
  const double aside = std::atan2(ahead.y, ahead.x);
  is_turning_ = std::abs(aside) > (is_turning_ ? end_to_turn : begin_to_turn);
  if (is_turning_)
    return turn_to(aside, MovementStatus::moving, {});
  // The arc to the goal (pure pursuit), of which only the next part is driven.
  const double away_squared = ahead.x * ahead.x + ahead.y * ahead.y;
  const double curvature = away_squared > 0 ? 2 * ahead.y / away_squared : 0;
  speed = std::min({speed, speed_ + options_.acceleration * dt_,
                    options_.speed / (1 + 0.5 * std::abs(curvature))});
  if (std::abs(curvature) * speed > options_.max_turn)
    speed = options_.max_turn / std::abs(curvature);
  const double reach = speed * speed / (2 * options_.braking) + speed * options_.reaction + 0.1;
  const Twist2 wanted{std::max(speed, slowest), curvature * std::max(speed, slowest)};
  const double left = free_arc(robot, wanted, seen, options_.radius, options_.gap, reach);
  if (left < reach)
    speed = std::min(speed, speed_to_stop_within(left, options_.reaction, options_.braking));
  if (left < reach && speed < slowest) {
    if (!blocked_since_)
      blocked_since_ = time_;
    return turn_to(aside, MovementStatus::waiting, "a free way");
  }
  blocked_since_.reset();
  speed_ = speed;
  return {{speed, curvature * speed}, MovementStatus::moving, {}, {}};
}

PersonFollower::Step PersonFollower::turn_to(double aside, MovementStatus status,
                                             const std::string& waits_for) {
  speed_ = 0;
  constexpr double enough = 0.1; // radians
  const double turn =
    std::abs(aside) < enough ? 0 : std::clamp(1.5 * aside, -options_.max_turn, options_.max_turn);
  return {{0, turn}, status, waits_for, {}};
}

PersonFollower::Step PersonFollower::fail(const std::string& reason) {
  speed_ = 0;
  return {{}, MovementStatus::failed, {}, reason};
}

} // namespace castor::mapping
