#pragma once

#include "castor/mapping/planar/types.hpp"

#include <cstdint>
#include <string>

/// What a robot's body says of itself beside its sensors.
namespace castor::mapping {

/// Push and pull: what the simulator knows of the robot, for evaluation. A robot does not know it.
struct BodyStatus {
  /// Microseconds since the system began.
  std::int64_t time = 0;
  /// True pose in the building.
  Pose2 pose;
  /// True velocity.
  Twist2 velocity;
  /// How often it has run into something.
  std::int64_t collisions = 0;
  /// It touches something, and was told to drive on.
  bool blocked = false;
  /// From the edge of the robot to the nearest obstacle, at most 1 m.
  double clearance = 0;
  /// Smallest clearance so far.
  double least_clearance = 0;
  /// True length of the way so far, metres.
  double driven = 0;

  friend bool operator==(const BodyStatus&, const BodyStatus&) = default;
};

/// Entry: who holds a lease of it may drive the robot (`SimulatedRobot --lease`).
struct DriverSeat {
  /// Component that sits in it.
  std::string driver;

  friend bool operator==(const DriverSeat&, const DriverSeat&) = default;
};

/// Entry: how far along its path a PathDriver is. Its id is the component's name.
struct PathProgress {
  /// When that was, microseconds since the system began.
  std::int64_t time = 0;
  /// Metres along the path, and its length.
  double done = 0;
  double length = 0;
  /// Rounds that were completed.
  std::int64_t rounds = 0;
  bool arrived = false;
  /// Why the robot stands; empty if it drives or has arrived.
  std::string waits_for;

  friend bool operator==(const PathProgress&, const PathProgress&) = default;
};

CASTOR_REFLECT(BodyStatus, time, pose, velocity, collisions, blocked, clearance, least_clearance,
               driven)
CASTOR_REFLECT(DriverSeat, driver)
CASTOR_REFLECT(PathProgress, time, done, length, rounds, arrived, waits_for)

} // namespace castor::mapping
