#pragma once

#include "castor/mapping/building/building.hpp"
#include "castor/mapping/building/obstacles.hpp"

#include <optional>
#include <span>
#include <vector>

namespace castor::mapping {

/// People who walk along their routes. They stop before a robot that is in their way; after a
/// moment they walk around it where there is room, and else they walk back. So whoever runs into
/// whom is the robot. They do not see one another.
class WalkingPeople {
public:
  explicit WalkingPeople(std::vector<Walker> people);

  /// @param dt seconds
  /// @param fixed where they do not go when they leave their routes
  void step(double dt, const Disc& robot, const Obstacles& fixed);

  /// Where they are.
  std::span<const Disc> discs() const { return discs_; }

  /// Their legs, two each, as they walk.
  std::vector<Disc> legs() const;

private:
  /// A way around a robot.
  struct Detour {
    /// Where on the route it ends.
    double to = 0;
    /// On which side the robot is passed: 1 or -1, or 0 as long as nothing is in the way.
    double side = 0;
    /// Of the last step, radians.
    double heading = 0;
    /// Since it began, seconds.
    double time = 0;
  };

  struct Walk {
    Walker person;
    /// How far along the route, from its beginning.
    double at = 0;
    /// 1 or, after turning back, -1.
    double direction = 1;
    /// For the robot, seconds.
    double waited = 0;
    /// What is left of the pause at a point of the route, seconds.
    double pause = 0;
    std::optional<Detour> detour;
  };

  /// @param gap that is kept from the robot, metres
  void walk_on(Walk& walk, Point2& here, double dt, const Disc& robot, double gap) const;
  void walk_around(Walk& walk, Point2& here, double dt, const Disc& robot, double gap,
                   const Obstacles& fixed) const;

  std::vector<Walk> walks_;
  std::vector<Disc> discs_;
  /// Where the robot was at the last step.
  std::optional<Point2> robot_before_;
};

} // namespace castor::mapping
