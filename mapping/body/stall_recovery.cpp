#include "castor/mapping/body/stall_recovery.hpp"

#include <cmath>
#include <cstddef>
#include <utility>

namespace castor::mapping {

namespace {

/// Between points of the trail, metres.
constexpr double spacing = 0.1;
/// A pose that is so far from the last one was corrected, not driven to, metres.
constexpr double jump = 0.15;
constexpr std::size_t longest_trail = 100;

} // namespace

bool StallRecovery::has_stalled(std::int64_t time, const Pose2& robot, bool is_to_move) {
  const Point2 place{robot.x, robot.y};
  if (!trail_.empty() && distance(trail_.front(), place) > spacing + jump) {
    // The trail is moved along with the pose, to where it was left.
    const double x = place.x - trail_.front().x;
    const double y = place.y - trail_.front().y;
    for (auto& point : trail_)
      point = {point.x + x, point.y + y};
  }
  if (trail_.empty() || distance(trail_.front(), place) >= spacing)
    trail_.push_front(place);
  if (trail_.size() > longest_trail)
    trail_.pop_back();
  if (!is_to_move) {
    since_.reset();
    return false;
  }
  if (!since_ || distance(from_, robot) > options_.least_way ||
      std::abs(normalised(robot.heading - from_.heading)) > options_.least_turn) {
    since_ = time;
    from_ = robot;
  }
  if (time - *since_ < options_.patience)
    return false;
  since_.reset();
  return true;
}

bool StallRecovery::begin(std::int64_t time, const Pose2& robot) {
  Path back{{robot.x, robot.y}};
  double way = 0;
  for (const auto& x : trail_) {
    if (way >= options_.way_back)
      break;
    way += distance(back.back(), x);
    if (back.back() != x)
      back.push_back(x);
  }
  if (back.size() < 3)
    return false;
  FollowOptions follow;
  follow.speed = options_.speed;
  follow.look_ahead = 2 * spacing;
  follow.tolerance = spacing;
  follower_.emplace(std::move(back), follow);
  begun_ = time;
  since_.reset();
  return true;
}

std::optional<Twist2> StallRecovery::velocity(std::int64_t time, const Pose2& robot) {
  if (!follower_)
    return std::nullopt;
  const auto result = follower_->velocity_at(robot);
  if (!follower_->has_arrived() && time - begun_ < options_.longest)
    return result;
  follower_.reset();
  // The trail ends here now.
  const Point2 place{robot.x, robot.y};
  while (trail_.size() > 1 && distance(trail_[1], place) < distance(trail_[0], place))
    trail_.pop_front();
  return std::nullopt;
}

} // namespace castor::mapping
