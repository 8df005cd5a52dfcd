#pragma once

#include "castor/planning/manipulation/arm_model.hpp"
#include "castor/planning/manipulation/scene.hpp"

#include <cstddef>
#include <string>

/// An arm at a table for MuJoCo, a simulator of others, as a check of our own.
namespace castor::manipulation {

struct PhysicsOptions {
  /// Length of a step, seconds.
  double step = 0.002;
  /// Of things, kg/m3; wood.
  double density = 500;
  /// How strongly a finger presses, newtons.
  double grip = 15;
  /// Coefficients of sliding friction of things, and of rubber fingers.
  double friction = 0.6;
  double finger_friction = 1.2;
};

/// Stiffness and damping of the motors of joints, N m/rad and N m s/rad.
inline constexpr double joint_stiffness = 4000;
inline constexpr double joint_damping = 80;

/// Name of the slide of a finger: 0 or 1, in the order of `fingers()`. At 0 they meet.
std::string finger_joint(std::size_t finger);

/// Names of what touches: those of things, "the table", of fingers the names of their slides, of
/// links those of links.
///
/// The first thing of the scene is the table, of which only the height of its top counts: it has no
/// edge. All others move freely. Parts of the arm do not touch one another. A motor for each joint
/// that moves, in their order, and one for each finger. \throws std::invalid_argument if the arm
/// has no gripper, or the scene no table
std::string physics_model(const ArmModel& arm, const Scene& scene,
                          const PhysicsOptions& options = {});

} // namespace castor::manipulation
