#pragma once

#include "castor/planning/manipulation/collision_checker.hpp"
#include "castor/planning/manipulation/inverse_kinematics.hpp"

#include <optional>
#include <span>
#include <vector>

namespace castor::manipulation {

/// Configurations that move the tool on a straight line, as towards a thing that is grasped: from
/// the tool's pose at `from` to `tool`, turning evenly. Nothing if the line leaves the arm's reach,
/// if the arm would have to change its posture on the way, or if it touches something.
/// @param spacing of the configurations, metres along the line
std::optional<std::vector<Configuration>>
straight_motion(const ArmModel& arm, const InverseKinematics& inverse, CollisionChecker& checker,
                const Configuration& from, const Pose& tool, double spacing = 0.01);

/// The tool goes back from `tool`, where it is with the joints `from`, along its own z axis: by the
/// first of these distances, metres, for which it can. Nothing if it can for none.
std::optional<std::vector<Configuration>>
way_back(const ArmModel& arm, const InverseKinematics& inverse, CollisionChecker& checker,
         const Configuration& from, const Pose& tool, std::span<const double> distances);

} // namespace castor::manipulation
