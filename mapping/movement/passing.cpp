#include "castor/mapping/movement/passing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace castor::mapping {

namespace {

constexpr double time_step = 0.1; // seconds
constexpr int steps_of_command = 2;

/// What a way costs, in metres of progress: a metre aside, and a metre of change of that. People
/// who meet keep to the right.
constexpr double cost_of_shift = 0.15;
constexpr double cost_of_change = 0.3;
constexpr double cost_of_left = 0.03;
/// What a metre more of clearance is worth, up to so much.
constexpr double worth_of_clearance = 0.2;
constexpr double enough_clearance = 0.5;

struct Rollout {
  bool is_safe = true;
  /// Along the path, metres.
  double progress = 0;
  /// Least distance from anybody, edge to edge, metres.
  double clearance = enough_clearance;
};

/// Follows the path for so long, seconds, or until that is not safe.
Rollout roll_out(PathFollower follower, const Pose2& robot, const Passing& passing, double horizon,
                 std::span<const Mover> movers, const MoverOptions& mover_options,
                 const std::function<bool(const Point2&)>& is_free, const PassingOptions& options) {
  Rollout result;
  const Point2 here{robot.x, robot.y};
  const double begin = follower.done();
  const double radii = mover_options.robot_radius + mover_options.mover_radius;
  auto pose = robot;
  Twist2 velocity;
  const int steps = static_cast<int>(std::floor(horizon / time_step));
  for (int i = 0; i < steps; ++i) {
    if (i % steps_of_command == 0) {
      velocity = velocity_aside(follower, pose, passing.shift, options);
      if (velocity.forward > passing.speed) {
        velocity.turn *= passing.speed / velocity.forward;
        velocity.forward = passing.speed;
      }
    }
    const double t = (i + 1) * time_step;
    pose = moved(pose, velocity, time_step);
    const Point2 there{pose.x, pose.y};
    if (passing.shift != 0 && !is_free(there))
      return {false, 0, 0};
    const double kept = radii + gap_at(velocity.forward, mover_options);
    for (const auto& x : movers) {
      const auto place = place_after(x, t);
      const double away = distance(place, there);
      constexpr double rounding = 1e-6;
      if (away < kept && away < distance(place, here) - rounding)
        return {false, 0, 0};
      result.clearance = std::min(result.clearance, away - radii);
    }
  }
  result.progress = follower.done() - begin;
  return result;
}

} // namespace

Twist2 velocity_aside(PathFollower& follower, const Pose2& robot, double shift,
                      const PassingOptions& options) {
  const double aside = follower.aside(robot);
  return follower.velocity_at(robot, aside + std::clamp(shift - aside, -options.aim, options.aim));
}

std::optional<Passing> choose_passing(const PathFollower& follower, const Pose2& robot,
                                      double before, double fastest, std::span<const Mover> movers,
                                      const MoverOptions& mover_options,
                                      const std::function<bool(const Point2&)>& is_free,
                                      const PassingOptions& options) {
  const Point2 here{robot.x, robot.y};
  const double radii = mover_options.robot_radius + mover_options.mover_radius;
  std::vector<Mover> near;
  for (const auto& x : movers)
    if (distance(x.place, here) <
        (fastest + x.speed()) * options.horizon + radii + gap_at(fastest, mover_options))
      near.push_back(x);
  if (near.empty())
    return Passing{0, fastest};
  const auto follow = [&](const Passing& passing, double horizon) {
    return roll_out(follower, robot, passing, horizon, near, mover_options, is_free, options);
  };
  if (before == 0 && follow({0, fastest}, options.horizon).is_safe)
    return Passing{0, fastest};
  const double most = std::min(options.most_shift, (follower.length() - follower.done()) / 2);
  std::vector<double> shifts{0};
  for (double x = options.shift_step; x <= most; x += options.shift_step)
    shifts.insert(shifts.end(), {-x, x});
  const std::array<double, 4> speeds{fastest, (fastest + mover_options.near_speed) / 2,
                                     mover_options.near_speed, options.slowest};
  for (const double horizon : {options.horizon, mover_options.horizon}) {
    std::optional<Passing> best;
    double best_score = 0;
    for (const double speed : speeds)
      for (const double shift : shifts) {
        const auto x = follow({shift, std::min(speed, fastest)}, horizon);
        const double score =
          x.progress + worth_of_clearance * x.clearance - cost_of_shift * std::abs(shift) -
          cost_of_change * std::abs(shift - before) - (shift > 0 ? cost_of_left : 0);
        if (x.is_safe && (!best || score > best_score)) {
          best = Passing{shift, std::min(speed, fastest)};
          best_score = score;
        }
      }
    if (best)
      return best;
  }
  return std::nullopt;
}

} // namespace castor::mapping
