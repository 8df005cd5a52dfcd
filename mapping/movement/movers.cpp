#include "castor/mapping/movement/movers.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace castor::mapping {

namespace {

constexpr double time_step = 0.1; // seconds

/// Whether nobody comes too near because the robot drives.
bool is_safe(const Pose2& robot, const Twist2& velocity, std::span<const Mover> movers,
             const MoverOptions& options) {
  const double kept = options.robot_radius + options.mover_radius + options.gap;
  const Point2 here{robot.x, robot.y};
  for (double t = time_step; t <= options.horizon; t += time_step) {
    const auto then = moved(robot, velocity, t);
    for (const auto& x : movers) {
      const auto place = place_after(x, t);
      const double away = distance(place, {then.x, then.y});
      constexpr double rounding = 1e-6;
      if (away < kept && away < distance(place, here) - rounding)
        return false;
    }
  }
  return true;
}

/// Whether somebody is behind a robot that drives on, and the two part.
bool has_passed(const Pose2& robot, const Twist2& wanted, const Mover& x) {
  const auto soon = moved(robot, wanted, time_step);
  const auto place = place_after(x, time_step);
  const auto from_robot = transform(inverse(robot), x.place);
  return from_robot.x * wanted.forward < 0 &&
         distance(place, {soon.x, soon.y}) > distance(x.place, {robot.x, robot.y});
}

} // namespace

Point2 place_after(const Mover& x, double seconds) {
  return {x.place.x + x.velocity.x * seconds, x.place.y + x.velocity.y * seconds};
}

double gap_at(double speed, const MoverOptions& options) {
  const double slow = options.near_speed;
  return speed <= slow ? options.passing_gap * speed / slow
                       : options.passing_gap + options.passing_time * (speed - slow);
}

double share_among_movers(const Pose2& robot, const Twist2& wanted, std::span<const Mover> movers,
                          const MoverOptions& options) {
  const double fast = std::abs(wanted.forward);
  if (fast == 0 || movers.empty())
    return 1;
  std::vector<Mover> near;
  double limit = 1;
  for (const auto& x : movers) {
    const double away =
      distance(x.place, {robot.x, robot.y}) - options.robot_radius - options.mover_radius;
    if (away < options.near && !has_passed(robot, wanted, x))
      limit = std::min(limit, options.near_speed / fast);
    if (x.speed() >= options.least_speed && away < (fast + x.speed()) * options.horizon)
      near.push_back(x);
  }
  constexpr int shares = 5;
  for (int i = shares; i > 0; --i) {
    const double share = limit * i / shares;
    if (is_safe(robot, {share * wanted.forward, share * wanted.turn}, near, options))
      return share;
  }
  return 0;
}

} // namespace castor::mapping
