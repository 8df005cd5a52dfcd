#pragma once

#include "castor/mapping/body/differential_drive.hpp"
#include "castor/mapping/body/footprint.hpp"
#include "castor/mapping/body/laser_model.hpp"
#include "castor/mapping/body/types.hpp"
#include "castor/mapping/body/walking_people.hpp"
#include "castor/mapping/building/building.hpp"

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>

namespace castor::mapping {

struct BodyOptions {
  /// Footprint of the robot, a disc, metres; or what it has in place of that.
  double radius = 0.25;
  std::optional<Footprint> footprint;
  /// What is higher is not in its way, metres.
  double height = 0.5;
  /// Of the laser's plane above the floor, metres.
  double laser_height = 0.3;
  DriveOptions drive;
  LaserOptions laser;
  bool people = false;
  /// Whether the laser sees their legs; else it sees them as discs.
  bool legs = false;
  /// Whether they keep clear of one another and of the robot, or walk through one another.
  bool considerate = false;
  /// Where odometry begins; that it is at the robot's start makes it easy to compare.
  Pose2 odometry_start;
  /// Of the noise.
  std::uint64_t seed = 1;
  /// Length of a step.
  std::chrono::microseconds step{10'000};
};

/// What robots need to know of where they drive.
struct BodySurroundings {
  /// What the robot may run into.
  std::unique_ptr<Obstacles> obstacles;
  /// What its laser sees.
  std::unique_ptr<Obstacles> seen;
  Pose2 start;
  std::vector<Walker> people;
};

BodySurroundings surroundings_in(const Building& x, const BodyOptions& options);

/// What of a body outlives the program that simulates it. It stands then.
struct BodyState {
  Pose2 pose;
  Pose2 odometry;
  std::int64_t collisions = 0;
  double least_clearance = 0;
  double driven = 0;

  friend bool operator==(const BodyState&, const BodyState&) = default;
};

/// A robot that drives in a building, in steps of equal length. What it does depends on the
/// options, the commands and the steps before which they come, and on nothing else.
///
/// A step that would take the robot into something is not done: the robot stands, and that is a
/// collision. It stays blocked as long as it is told to drive on in that direction, and has not
/// come away from the obstacle. It may turn, as far as its footprint does not touch anything by
/// that, and drive away.
class SimulatedBody {
public:
  /// \throws std::invalid_argument if the robot does not fit where it is to begin, if it could pass
  /// through something within a step, or if the options of the laser are wrong.
  SimulatedBody(BodySurroundings surroundings, const BodyOptions& options);

  /// Holds until the next command, at most for so long, as by the watchdog of a motor; without one,
  /// the robot stands.
  void command(const Twist2& velocity,
               std::chrono::microseconds holds = std::chrono::microseconds::max());

  /// One step.
  void step();

  /// Number of steps so far.
  std::int64_t steps() const { return steps_; }
  /// Simulated time since the first step began.
  std::chrono::microseconds time() const { return steps_ * options_.step; }

  // What it measures now. Times are those of this body; `scan` draws new noise each time.
  Odometry odometry() const;
  LaserScan scan();
  BodyStatus status() const;

  BodyState state() const;
  /// Goes on from that state.
  void resume(const BodyState& x);

  const WalkingPeople& people() const { return people_; }

  /// Fault injection: somebody carries the robot to another place, where it stands. Its wheels do
  /// not notice.
  /// \throws std::invalid_argument if it does not fit there.
  void carry_to(const Pose2& pose);

  /// Fault injection: from now on that wheel does not turn.
  void block(Wheel wheel) { drive_.block(wheel); }

private:
  /// From the robot's edge, metres, at most 1 m; negative where it touches something.
  double room_at(const Pose2& pose) const;
  /// The same of a robot that fits there.
  double clearance_of_robot_at(const Pose2& pose) const;
  /// Turns it on the spot as far as its footprint permits that.
  void turn_blocked(const DifferentialDrive::Step& step, double here);

  /// Whether a robot that is blocked is told to move on as before.
  bool is_pushed_on() const;

  BodyOptions options_;
  BodySurroundings surroundings_;
  DifferentialDrive drive_;
  LaserModel laser_;
  WalkingPeople people_;
  std::int64_t steps_ = 0;
  /// Time until which the command holds.
  std::chrono::microseconds commanded_until_ = std::chrono::microseconds::max();
  Pose2 pose_;
  Pose2 odometry_;
  Twist2 velocity_;
  Twist2 measured_velocity_;
  std::int64_t collisions_ = 0;
  bool blocked_ = false;
  bool blocked_backwards_ = false;
  double clearance_ = 0;
  double least_clearance_ = 0;
  double driven_ = 0;
};

} // namespace castor::mapping
