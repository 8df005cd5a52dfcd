#pragma once

#include "castor/mapping/body/mutual_avoidance.hpp"
#include "castor/mapping/building/building.hpp"
#include "castor/mapping/building/obstacles.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace castor::mapping {

/// People who walk along their routes. They stop before a robot that is in their way; after a
/// moment they walk around it where there is room, and else they walk back. So whoever runs into
/// whom is the robot.
///
/// Considerate people keep clear of one another and of the robot as they walk (mutual_avoidance),
/// and return to their routes; who gets no further, as in a door, squeezes past. Others do not see
/// one another, and walk through one another.
class WalkingPeople {
public:
  explicit WalkingPeople(std::vector<Walker> people, bool considerate = false);

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
    /// Of now, m/s.
    double speed = 0;
    std::optional<Detour> detour;
    // Of considerate people:
    /// Off the route, to keep clear of somebody.
    bool is_aside = false;
    /// m/s.
    Point2 velocity;
    /// Of walking while aside, radians.
    double heading = 0;
    /// For how long somebody was in the way, seconds, less those since.
    double hindered = 0;
  };

  /// What considerate people know of the robot.
  struct Robot {
    Disc disc;
    /// m/s.
    Point2 velocity;
  };

  /// @param gap that is kept from the robot, metres
  static void walk_on(Walk& walk, Point2& here, double dt, const Disc& robot, double gap);
  void walk_around(std::size_t i, double dt, const Disc& robot, double gap, const Obstacles& fixed);
  /// The robot was in the way for another moment.
  static void wait_for_robot(Walk& walk, double dt);

  void walk_among(std::size_t i, double dt, const Robot& robot, const Obstacles& fixed);
  /// Whom one who walks in that direction keeps clear of.
  std::vector<AvoidedDisc> avoided_by(std::size_t i, const Point2& wanted,
                                      const Robot& robot) const;
  /// Distance of the middles of two people that they keep, metres.
  double reach(std::size_t i, std::size_t j) const;
  /// Whether a step brings one too near to somebody.
  bool runs_into_somebody(std::size_t i, const Point2& next) const;
  static void remember_hindrance(Walk& walk, bool is_hindered, double dt);
  /// How far ahead on the route somebody aims who is aside of it, metres: less when hindered.
  static double ahead_of(const Walk& walk);
  /// Takes down how far along the route somebody is who is aside of it.
  /// @param evades whether somebody is in the way
  void keep_up(Walk& walk, Point2& here, bool evades, double dt) const;

  bool considerate_;
  std::vector<Walk> walks_;
  std::vector<Disc> discs_;
  /// Where the robot was at the last step.
  std::optional<Point2> robot_before_;
};

} // namespace castor::mapping
