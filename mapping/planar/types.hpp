#pragma once

#include "castor/wm/values/reflect.hpp"

#include <cstdint>
#include <string>
#include <vector>

/// Robots that drive over a floor: what they are told, what they sense, where they are. Metres,
/// radians, seconds unless a field says otherwise; angles anticlockwise as seen from above.
namespace castor::mapping {

/// Where something is on the floor and which way it faces, in a frame that the context names.
struct Pose2 {
  double x = 0;
  double y = 0;
  /// From the x axis of the frame, within (-pi, pi].
  double heading = 0;

  friend bool operator==(const Pose2&, const Pose2&) = default;
};

/// Velocity of a robot in its own frame.
struct Twist2 {
  /// m/s; negative backwards.
  double forward = 0;
  /// rad/s.
  double turn = 0;

  friend bool operator==(const Twist2&, const Twist2&) = default;
};

/// Command: the velocity that a wheeled base is to have.
struct DriveCommand {
  Twist2 velocity;

  friend bool operator==(const DriveCommand&, const DriveCommand&) = default;
};

/// Push and pull: where the wheels of a base say that it is. It drifts.
struct Odometry {
  /// When it was measured, microseconds since the system began.
  std::int64_t time = 0;
  /// In the odometry frame.
  Pose2 pose;
  Twist2 velocity;

  friend bool operator==(const Odometry&, const Odometry&) = default;
};

/// Push and pull: one sweep of a laser scanner, anticlockwise.
struct LaserScan {
  /// When it was measured, microseconds since the system began.
  std::int64_t time = 0;
  /// The scanner on the robot.
  Pose2 mount;
  /// Of the first beam, from the scanner's x axis.
  double first_angle = 0;
  /// From one beam to the next.
  double angle_step = 0;
  double max_range = 0;
  /// One for each beam; 0 where nothing came back.
  std::vector<float> ranges;

  friend bool operator==(const LaserScan&, const LaserScan&) = default;
};

CASTOR_REFLECT(Pose2, x, y, heading)
CASTOR_REFLECT(Twist2, forward, turn)
CASTOR_REFLECT(DriveCommand, velocity)
CASTOR_REFLECT(Odometry, time, pose, velocity)
CASTOR_REFLECT(LaserScan, time, mount, first_angle, angle_step, max_range, ranges)

} // namespace castor::mapping
