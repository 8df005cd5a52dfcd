#pragma once

#include "castor/planning/manipulation/blocked_way.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace castor::manipulation {

enum class PlanningAlgorithm {
  /// The first way that is found, in milliseconds.
  rrt_connect,
  // Shorter ways, which use the whole time limit.
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

using MotionResult = std::variant<JointPath, MotionFailure>;

/// Plans a motion to the first of the goals that is found, by OMPL. Motions have no contact between
/// configurations either (CollisionChecker::step). Where there is none, finds out what is in the
/// way. Callers in several threads wait for each other.
/// @param goals configurations within the limits, of which one has to be reached
/// @param destination for messages: "the ball"
/// \throws std::invalid_argument if a configuration is not one of this arm, or there is no goal.
MotionResult plan_motion(const ArmModel& arm, const Scene& scene, const Configuration& start,
                         const std::vector<Configuration>& goals, const std::string& destination,
                         const MotionPlannerOptions& options = {});

} // namespace castor::manipulation
