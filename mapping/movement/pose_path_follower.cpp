#include "castor/mapping/movement/pose_path_follower.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace castor::mapping {

namespace {

bool is_turn(const Twist2& x) {
  return x.forward == 0;
}

} // namespace

PosePathFollower::PosePathFollower(PosePath path, const PoseFollowOptions& options)
  : path_(std::move(path)), options_(options), begins_(begins_of(path_)),
    length_(mapping::length(path_)) {
  // nop
}

Pose2 PosePathFollower::reference() const {
  return has_arrived() ? end() : pose_on(begins_[motion_], path_.motions[motion_], share_);
}

void PosePathFollower::advance(const Pose2& robot) {
  constexpr double step = 0.005;  // metres
  constexpr double close = 0.01;  // metres
  constexpr double facing = 0.02; // radians
  while (!has_arrived()) {
    const auto& x = path_.motions[motion_];
    if (is_turn(x)) {
      if (std::abs(normalised(begins_[motion_ + 1].heading - robot.heading)) > facing)
        return;
    } else {
      const double way = std::abs(x.forward);
      const auto away = [&](double share) {
        return distance(pose_on(begins_[motion_], x, share), robot);
      };
      const double before = share_;
      while (share_ < 1) {
        const double next = std::min(1.0, share_ + step / way);
        if (away(next) >= away(share_))
          break;
        share_ = next;
      }
      done_ += (share_ - before) * way;
      if ((1 - share_) * way > close)
        return;
      done_ += (1 - share_) * way;
    }
    ++motion_;
    share_ = 0;
  }
}

Twist2 PosePathFollower::velocity_at(const Pose2& robot) {
  advance(robot);
  if (has_arrived())
    return {};
  return is_turn(path_.motions[motion_]) ? turn(robot) : drive(robot);
}

Twist2 PosePathFollower::turn(const Pose2& robot) const {
  // Turns of half a circle go the way round that is planned.
  const double planned = path_.motions[motion_].turn;
  double left = normalised(begins_[motion_ + 1].heading - robot.heading);
  constexpr double far = 2; // radians
  if (std::abs(left) > far && left * planned < 0)
    left = std::copysign(far, planned);
  constexpr double slowest = 0.1; // rad/s
  const double speed = std::clamp(1.5 * std::abs(left), slowest, options_.max_turn);
  return {0, std::copysign(speed, left)};
}

double PosePathFollower::way_to_stop() const {
  const auto& now = path_.motions[motion_];
  double result = (1 - share_) * std::abs(now.forward);
  for (auto i = motion_ + 1; i < path_.motions.size(); ++i) {
    if (!(path_.motions[i].forward * now.forward > 0))
      break;
    result += std::abs(path_.motions[i].forward);
  }
  return result;
}

Twist2 PosePathFollower::drive(const Pose2& robot) const {
  const auto& x = path_.motions[motion_];
  const double curvature = x.turn / x.forward;
  constexpr double slowest = 0.05; // m/s
  double speed = slowest + std::sqrt(2 * options_.braking * way_to_stop());
  speed = std::min(speed, options_.speed / (1 + 0.5 * std::abs(curvature)));
  if (std::abs(curvature) * speed > options_.max_turn)
    speed = options_.max_turn / std::abs(curvature);
  const double forward = std::copysign(speed, x.forward);
  const auto wrong = between(reference(), robot);
  // Errors die away within half a metre of way or so.
  constexpr double for_place = 12;  // 1/m^2
  constexpr double for_heading = 7; // 1/m
  double turn = forward * (curvature - for_place * wrong.y) - for_heading * speed * wrong.heading;
  const double most =
    options_.turning_radius > 0 ? speed / options_.turning_radius : options_.max_turn;
  turn = std::clamp(turn, -most, most);
  return {forward, turn};
}

std::vector<Pose2> PosePathFollower::ahead(double way, double radius, double step) const {
  std::vector<Pose2> result;
  double share = share_;
  for (auto i = motion_; i < path_.motions.size() && way > 0; ++i) {
    const auto& x = path_.motions[i];
    const double whole = std::abs(x.forward) + radius * std::abs(x.turn);
    for (double at = share * whole; at < whole && way > 0; at += step, way -= step)
      result.push_back(pose_on(begins_[i], x, at / whole));
    share = 0;
  }
  if (way > 0)
    result.push_back(end());
  return result;
}

} // namespace castor::mapping
