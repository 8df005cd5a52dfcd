#pragma once

#include "castor/planning/manipulation/arm_model.hpp"

#include <span>
#include <vector>

/// Forward kinematics.
namespace castor::manipulation {

/// Pose of the tool in the arm's frame.
/// \throws std::invalid_argument if there is not one number for each joint that moves.
Pose tool_pose(const ArmModel& arm, std::span<const double> configuration);

/// Poses of all links in the arm's frame, the base first. Throws as `tool_pose` does.
std::vector<Pose> link_poses(const ArmModel& arm, std::span<const double> configuration);

/// Euclidean distance of two configurations of an arm: radians, and metres of slides.
double distance(std::span<const double> a, std::span<const double> b);

} // namespace castor::manipulation
