#pragma once

#include "castor/mapping/body/noise.hpp"
#include "castor/mapping/planar/poses.hpp"

#include <cstdint>

namespace castor::mapping {

struct DriveOptions {
  /// Between the wheels, metres.
  double wheel_base = 0.4;
  /// m/s and m/s^2; faster commands are limited.
  double max_forward = 0.8;
  double acceleration = 0.8;
  /// rad/s and rad/s^2.
  double max_turn = 1.6;
  double turn_acceleration = 3;
  /// Least radius of the circles that it drives, metres, as of a car, which cannot turn on the
  /// spot; 0: it can.
  double turning_radius = 0;
  /// Standard deviation of what a wheel slips on a metre of way, metres. That of the sum grows with
  /// the root of the way.
  double slip = 0.003;
  /// Standard deviation of the relative error of each wheel's diameter, which is drawn once.
  double diameter_error = 0.0005;
};

enum class Wheel : std::uint8_t { none, left, right };

/// The base of a robot with two driven wheels: commands become velocities within limits, and wheels
/// that turn become motion over the floor. The wheels' encoders measure how they turn, and not that
/// they slip and that their diameters differ, so that odometry drifts.
class DifferentialDrive {
public:
  DifferentialDrive(const DriveOptions& options, std::uint64_t seed);

  /// Velocity to have as soon as acceleration permits; holds until the next command.
  void command(const Twist2& velocity);
  const Twist2& commanded() const { return commanded_; }

  /// How the robot moves within a step, and what its encoders measure of that, both as a pose
  /// relative to the one before.
  struct Step {
    Pose2 motion;
    Pose2 measured;
  };

  /// The next step.
  /// @param dt its length, seconds
  Step step(double dt);

  /// The wheels stand at once, as after a collision.
  void stop() { velocity_ = {}; }
  /// They may still turn the robot on the spot.
  void stop_driving() { velocity_.forward = 0; }

  /// Velocity of the wheels, as of a robot that does not slip.
  const Twist2& velocity() const { return velocity_; }

  /// From now on that wheel does not turn.
  void block(Wheel wheel) { blocked_ = wheel; }

private:
  /// How far a wheel moves over the floor that its encoder measured `way` of.
  double slipped(double way, double diameter_error);

  DriveOptions options_;
  Noise noise_;
  double left_error_;
  double right_error_;
  Twist2 commanded_;
  Twist2 velocity_;
  Wheel blocked_ = Wheel::none;
};

} // namespace castor::mapping
