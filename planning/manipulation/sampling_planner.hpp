#pragma once

#include "castor/planning/manipulation/joint_path.hpp"
#include "castor/planning/manipulation/motion_options.hpp"

#include <optional>

namespace castor::manipulation {

/// Planning by OMPL between free configurations, for plan_motion; OMPL's headers are
/// included by its source file only.
/// @param time_limit seconds
/// Returns nothing if no way was found in time.
std::optional<JointPath> sample_path(const ArmModel& arm, CollisionChecker& checker,
                                     const Configuration& start,
                                     const std::vector<Configuration>& goals,
                                     const MotionPlannerOptions& options, double time_limit);

} // namespace castor::manipulation
