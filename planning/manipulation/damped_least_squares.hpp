#pragma once

#include "castor/planning/manipulation/arm_model.hpp"

#include <cstdint>
#include <vector>

namespace castor::manipulation {

class KinematicChain;

struct DampedLeastSquaresOptions {
  /// Of a solution: distance of the position, metres, and angle of the rotation, radians.
  double tolerance = 1e-10;
  int max_iterations = 100;
  /// From how many configurations it is tried, the given one and random ones.
  int max_starts = 100;
  /// Of the random configurations.
  std::uint32_t seed = 1;
};

/// Inverse kinematics of any arm: least squares with the damping of Levenberg and Marquardt, within
/// the limits of the joints. Finds a solution near `start` if there is one, otherwise any that it
/// comes to, up to `wanted` different ones. It may miss solutions.
std::vector<Configuration>
solve_damped_least_squares(const ArmModel& arm, const KinematicChain& chain, const Pose& tool,
                           const Configuration& start, std::size_t wanted,
                           const DampedLeastSquaresOptions& options = {});

} // namespace castor::manipulation
