#pragma once

#include "castor/planning/manipulation/scene.hpp"

#include <cstddef>
#include <string>
#include <vector>

/// The scene while a plan is made: what things stand on, and what changes when one is held.
namespace castor::manipulation {

/// Grasps, places and directions for which whole motions are planned at most.
inline constexpr std::size_t most_tried = 6;

/// \throws std::invalid_argument if there is none of this name.
const NamedSolid& named(const Scene& scene, const std::string& name);

/// Names of what a thing stands on: all that ends just below it.
std::vector<std::string> supports_of(const Scene& scene, const NamedSolid& thing);

/// The scene in which the gripper holds one of its things.
/// @param tool its pose
Scene holding(Scene scene, const std::string& thing, const Pose& tool);

Pose raised(Pose x, double height);

/// The scene in which what the gripper holds was let go, and is where it was.
Scene released(Scene scene, const Pose& tool);

} // namespace castor::manipulation
