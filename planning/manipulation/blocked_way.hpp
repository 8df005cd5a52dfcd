#pragma once

#include "castor/planning/manipulation/collision_checker.hpp"

#include <functional>
#include <string>
#include <vector>

/// Why a motion is not possible, in words.
namespace castor::manipulation {

enum class MotionFailureKind {
  /// The arm touches something where it is.
  start_blocked,
  /// It would touch something where it is to go.
  goal_blocked,
  /// No configuration brings the tool there.
  out_of_reach,
  /// The gripper does not fit around what is to be grasped.
  no_grasp,
  /// Both ends are free, but no way between them was found.
  no_way
};

struct MotionFailure {
  MotionFailureKind kind = MotionFailureKind::no_way;
  /// Names of things that are in the way: without them the motion would be possible.
  std::vector<std::string> obstacles;
  /// What is in the way, and what would help: "the cube blocks every way to the ball".
  std::string text;
};

/// What the arm touches where it is.
MotionFailure blocked_start(const Contact& contact);

/// What the arm would touch, for each of its configurations at the destination.
MotionFailure blocked_goal(const std::vector<Contact>& contacts, const std::string& destination);

/// Whether there is a way without the things of these names.
using WayWithout = std::function<bool(const std::vector<std::string>&)>;

/// Finds out which of `things` block every way to the destination: one of them, if there is a way
/// without it, otherwise as few as possible that do so together.
MotionFailure blocked_way(const std::vector<std::string>& things, const std::string& destination,
                          const WayWithout& has_way_without);

/// "a, b and c".
std::string listed(const std::vector<std::string>& names, const std::string& conjunction = "and");

} // namespace castor::manipulation
