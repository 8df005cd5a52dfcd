#pragma once

#include "castor/planning/manipulation/arm_model.hpp"
#include "castor/planning/manipulation/scene.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

/// Where an arm may rest so that a camera sees the table, and not the arm.
namespace castor::manipulation {

/// How many of some points on and in the arm's moving links, its gripper and what it holds
/// are in the camera's picture.
/// @param camera in the arm's frame
std::size_t points_in_sight(const ArmModel& arm, std::span<const double> configuration,
                            const std::optional<NamedSolid>& held, const geometry::Camera& camera);

/// Configurations without contact in which no more points are in sight than there may be: the one
/// that is wanted, as far as joints that stand still permit it, then others at random, the nearest
/// to it first. The same arguments give the same ones.
/// @param camera in the arm's frame; null if it is not known where it is
/// @param most points in sight
std::vector<Configuration> hidden_postures(const ArmModel& arm, const Scene& scene,
                                           const Configuration& wanted,
                                           const geometry::Camera* camera, std::size_t most = 0);

} // namespace castor::manipulation
