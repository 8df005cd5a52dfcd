#pragma once

#include "castor/mapping/building/building.hpp"
#include "castor/mapping/building/obstacles.hpp"

#include <span>
#include <vector>

namespace castor::mapping {

/// People who walk along their routes. They wait while a robot is in their way, and walk back after
/// some time: whoever runs into whom is the robot.
class WalkingPeople {
public:
  explicit WalkingPeople(std::vector<Walker> people);

  /// @param dt seconds
  void step(double dt, const Disc& robot);

  /// Where they are.
  std::span<const Disc> discs() const { return discs_; }

  /// Their legs, two each, as they walk.
  std::vector<Disc> legs() const;

private:
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
  };

  std::vector<Walk> walks_;
  std::vector<Disc> discs_;
};

} // namespace castor::mapping
