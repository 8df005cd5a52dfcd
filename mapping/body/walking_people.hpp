#pragma once

#include "castor/mapping/building/building.hpp"
#include "castor/mapping/building/obstacles.hpp"

#include <span>
#include <vector>

namespace castor::mapping {

/// People who walk along their routes, and wait as long as a robot is in their way: whoever runs
/// into whom is the robot.
class WalkingPeople {
public:
  explicit WalkingPeople(std::vector<Person> people);

  /// @param dt seconds
  void step(double dt, const Disc& robot);

  /// Where they are.
  std::span<const Disc> discs() const { return discs_; }

private:
  std::vector<Person> people_;
  /// How far each has walked.
  std::vector<double> walked_;
  std::vector<Disc> discs_;
};

} // namespace castor::mapping
