#pragma once

#include "castor/planning/manipulation/collision_checker.hpp"

#include <cstdint>
#include <string_view>

namespace castor::manipulation {

enum class PlanningAlgorithm {
  /// The first way that is found, in milliseconds.
  rrt_connect,
  // Shorter ways, which use the whole time limit; if they find none, RRTConnect has as much again.
  rrt_star,
  bit_star
};

/// "rrt_connect", "rrt_star" or "bit_star".
/// \throws std::invalid_argument for others; lists those.
PlanningAlgorithm planning_algorithm(std::string_view name);

struct MotionPlannerOptions {
  PlanningAlgorithm algorithm = PlanningAlgorithm::rrt_connect;
  /// Seconds for a motion; RRTConnect ends as soon as there is one.
  double time_limit = 2;
  /// Seconds to shorten it; 0 for not at all.
  double simplification_time_limit = 0.5;
  /// Seconds for each question whether there would be a way without some things, where there is
  /// none.
  double explanation_time_limit = 0.5;
  /// Of random samples, more than 0; the same seed gives the same motion, if time does not run out.
  std::uint32_t seed = 1;
  CollisionOptions collisions;
};

} // namespace castor::manipulation
