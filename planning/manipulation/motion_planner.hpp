#pragma once

#include "castor/planning/manipulation/blocked_way.hpp"
#include "castor/planning/manipulation/joint_path.hpp"
#include "castor/planning/manipulation/motion_options.hpp"

#include <string>
#include <variant>
#include <vector>

namespace castor::manipulation {

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
