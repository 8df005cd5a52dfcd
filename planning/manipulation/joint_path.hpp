#pragma once

#include "castor/planning/manipulation/arm_model.hpp"

#include <cstddef>
#include <vector>

namespace castor::manipulation {

/// A motion without contact: straight lines between configurations, at least one.
struct JointPath {
  std::vector<Configuration> waypoints;

  // How it was found, for evaluation.

  /// Lengths in the Euclidean norm, radians: as found, and after simplification.
  double found_length = 0;
  double length = 0;
  /// Of collisions.
  std::size_t checks = 0;
};

/// Length in the Euclidean norm.
double path_length(const std::vector<Configuration>& waypoints);

} // namespace castor::manipulation
