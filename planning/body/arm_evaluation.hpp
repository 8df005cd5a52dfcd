#pragma once

#include "castor/planning/manipulation/types.hpp"
#include "castor/wm/values/reflect.hpp"

#include <cstdint>
#include <string>

/// Whether an arm does what it must not do, by the truth of a simulation.
namespace castor::manipulation {

/// Entry: what an ArmEvaluator has counted. Its id is the component's name; it is overwritten.
struct ArmEvaluation {
  /// Things taken, and put down.
  std::int64_t taken = 0;
  std::int64_t put_down = 0;
  /// Things that fell out of the gripper, but for those of injected faults, and the last in words.
  std::int64_t dropped = 0;
  std::string drop;
  /// Things on the floor.
  std::int64_t fallen = 0;
  /// Contacts of the arm, and the last in words.
  std::int64_t collisions = 0;
  std::string collision;
  /// Longest time that joints moved after the last command had expired, seconds.
  double uncommanded = 0;
  // -- what was seen last: the thing in the gripper and its height, metres; injected drops; way of
  // the joints, radians
  std::string held;
  double height = 0;
  std::int64_t injected = 0;
  double moved = 0;

  friend bool operator==(const ArmEvaluation&, const ArmEvaluation&) = default;
};

/// Adds what a status says. A thing that is not held any more has fallen if it is lower than 4 cm
/// below where it was while the arm has hardly moved.
void evaluate(ArmEvaluation& x, const ArmStatus& status);

CASTOR_REFLECT(ArmEvaluation, taken, put_down, dropped, drop, fallen, collisions, collision,
               uncommanded, held, height, injected, moved)

} // namespace castor::manipulation
