#pragma once

#include "castor/planning/manipulation/solid.hpp"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

/// What is known of an arm: a chain of links, moved by joints, with a gripper at its end.
namespace castor::manipulation {

/// The frame of an arm's base: z up.
inline constexpr const char* arm_frame = "arm";

/// One number for each joint that moves, from the base on: radians, of slides metres.
using Configuration = std::vector<double>;

enum class JointKind { turning, sliding, fixed };

/// What holds a link on the link before it.
struct Joint {
  std::string name;
  JointKind kind = JointKind::turning;
  /// The joint on the link before it; the link after it has this pose while the joint is at 0.
  Pose origin;
  /// Direction in the joint's frame that the joint turns about or slides along; of length 1.
  Point3 axis{0, 0, 1};
  /// Limits: radians, rad/s, rad/s^2; of slides metres, m/s, m/s^2. Zero for a fixed joint.
  double lower = 0;
  double upper = 0;
  double speed = 0;
  double acceleration = 0;
};

struct Link {
  std::string name;
  /// In the frame of the joint that moves the link; of the base, in the arm's frame.
  std::vector<PlacedSolid> shapes;
};

/// Two parallel fingers, which move along the y axis of the tool's frame.
struct Gripper {
  /// Distances of the fingers, metres.
  double narrowest = 0;
  double widest = 0.1;
  /// Of the opening, m/s.
  double speed = 0.1;
  /// Of a finger: its width along x, thickness along y, length along z; metres.
  Point3 finger{0.02, 0.012, 0.07};
  /// How far fingers reach beyond the origin of the tool's frame, metres.
  double beyond = 0.01;
};

struct ArmModel {
  std::string name;
  /// The base first; one more than joints.
  std::vector<Link> links;
  /// joints[i] moves links[i + 1] on links[i].
  std::vector<Joint> joints;
  /// The tool's frame on the last link: z is the direction that the arm grasps in.
  Pose tool;
  std::optional<Gripper> gripper;
  /// Where the arm rests: without contact of its parts, except those that always touch.
  Configuration home;
};

/// Indices of the joints that move, from the base on.
std::vector<std::size_t> moving_joints(const ArmModel& arm);

/// Whether each number is within the limits of its joint, or beyond by at most `tolerance`. False
/// for a configuration of another arm.
bool within_limits(const ArmModel& arm, std::span<const double> configuration,
                   double tolerance = 1e-9);

/// Whether the limits of a joint let it stand at one place only.
bool stands_still(const Joint& joint);

/// The arm of which one of the moving joints does not move any more. Configurations keep a number
/// for it.
/// @param index of the joint in a configuration
/// @param at where it stands
/// \throws std::out_of_range if there is no such joint.
ArmModel with_still_joint(ArmModel arm, std::size_t index, double at);

/// The configuration, with each joint at its nearest place within the limits.
Configuration kept_within_limits(const ArmModel& arm, Configuration configuration);

/// Largest distance of the tool's origin from the origin of the first moving joint that the lengths
/// of links permit, metres; limits of turning joints are not taken into account.
double reach(const ArmModel& arm);

/// Upper bounds of how far any point of the arm, or of what it holds up to `beyond_tool` metres
/// from the tool's origin, moves for each radian, or metre, of each moving joint.
std::vector<double> lever_arms(const ArmModel& arm, double beyond_tool);

/// The fingers in the tool's frame, opened that far, metres. Empty without a gripper.
std::vector<PlacedSolid> fingers(const ArmModel& arm, double opening);

/// What is in the way of the fingers' middles when they close, around the tool's origin.
/// @param opening metres
Solid gap_between_fingers(const Gripper& gripper, double opening);

} // namespace castor::manipulation
