#pragma once

#include "castor/mapping/planar/types.hpp"

#include <cstdint>

/// What a guard between commanders and the base of a robot says of itself.
namespace castor::mapping {

/// Why a robot may not drive as it was told to.
enum class SafetyReason {
  none,
  /// Nobody commands, or the last command has expired.
  no_command,
  /// No scan came lately.
  laser_silent,
  /// The same scan comes again and again.
  laser_frozen,
  /// No odometry came lately.
  odometry_silent,
  /// Something is within the stopping distance.
  obstacle,
  /// The laser does not see where the robot would drive.
  unseen_side
};

/// Push and pull: what the guard makes of the commands.
struct SafetyState {
  /// Microseconds since the system began.
  std::int64_t time = 0;
  Twist2 commanded;
  Twist2 allowed;
  SafetyReason reason = SafetyReason::none;
  /// How far the robot could drive as commanded until it touches something that the laser sees,
  /// metres, at most the laser's range.
  double free_way = 0;

  friend bool operator==(const SafetyState&, const SafetyState&) = default;
};

CASTOR_REFLECT_ENUM(SafetyReason, none, no_command, laser_silent, laser_frozen, odometry_silent,
                    obstacle, unseen_side)
CASTOR_REFLECT(SafetyState, time, commanded, allowed, reason, free_way)

} // namespace castor::mapping
