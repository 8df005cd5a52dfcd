#pragma once

#include "castor/planning/body/motion_reference.hpp"
#include "castor/planning/manipulation/arm_model.hpp"
#include "castor/planning/manipulation/collision_checker.hpp"
#include "castor/planning/manipulation/table_world.hpp"
#include "castor/planning/manipulation/types.hpp"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <random>
#include <string>
#include <vector>

namespace castor::manipulation {

struct ArmBodyOptions {
  /// Length of a step.
  std::chrono::microseconds step{10'000};
  /// Seconds from full speed to rest.
  double stop_time = 0.8;
  /// A joint that is further from where it ought to be does not follow: all brake; radians.
  double most_lag = 0.05;
  /// Of injected faults.
  std::uint64_t seed = 1;
  /// Probability that fingers slip off a thing when they close on it.
  double missed_grasp = 0;
  /// Probability that a thing that was grasped is lost within `dropped_within` seconds.
  double dropped = 0;
  double dropped_within = 4;
};

/// What outlives the process that simulates an arm: all but speeds and the motion it is on.
struct SavedArm {
  Configuration positions;
  double opening = 0;
  std::uint64_t changes = 0;
  std::int64_t collisions = 0;
  std::int64_t missed = 0;
  std::int64_t dropped = 0;
  double moved = 0;
  std::vector<WorldThing> things;
};

/// An arm at a table, in steps of equal length. What it does depends on the options, the commands
/// and the steps before which they come, and on nothing else.
///
/// Joints keep the limits of the arm's file. A step that would take the arm into something is not
/// done: the arm stands, and that is a collision. Fingers that close on a thing hold it, but what
/// is round slips out if they do not touch it where it is widest. Things are pushed by the gripper
/// if the command says so. Fingers that open push what stands beside them; that is a collision,
/// too, and they stop where it cannot give way.
class ArmBody {
public:
  /// \throws std::invalid_argument if `start` is no configuration within the limits, or in contact
  ArmBody(ArmModel arm, TableWorld world, const Configuration& start,
          const ArmBodyOptions& options = {});

  /// Obeyed until the next command, at most for so long, as by the watchdog of a motor.
  /// \throws std::invalid_argument as MotionReference::follow does.
  void command(const ArmCommand& command,
               std::chrono::microseconds holds = std::chrono::microseconds::max());

  /// Comes to rest on its motion within the stop time.
  void release();

  /// One step.
  void step();

  /// Number of steps so far.
  std::int64_t steps() const { return steps_; }
  /// Simulated time since the first step began.
  std::chrono::microseconds time() const { return steps_ * options_.step; }

  // Times are those of this body.
  ArmState state() const;
  /// Things are in the arm's frame.
  ArmStatus status() const;

  const ArmModel& arm() const { return arm_; }
  const TableWorld& world() const { return world_; }
  /// Joints of now.
  const Configuration& configuration() const { return positions_; }
  double opening() const { return opening_; }
  /// Number of changes of what a camera sees.
  std::uint64_t changes() const { return changes_; }

  SavedArm saved() const;

  /// Goes on, at rest, from where another one was.
  /// \throws std::invalid_argument if that is no state of this arm and table.
  void resume(const SavedArm& x);

  /// Fault injection: from now on that joint, of those that move, does not move.
  void stick(std::size_t joint) { stuck_ = joint; }

private:
  bool goes_on() const;
  bool is_still() const;
  void move_joints(double seconds);
  void move_fingers(double seconds);
  /// Moves things that the gripper pushes there. Returns what it touches all the same.
  std::optional<Contact> contact_at(const Configuration& positions);
  /// In a direction, until the arm is free of it with its joints there. False if it is not then.
  bool push_away(const std::string& thing, const Configuration& positions, double along_x,
                 double along_y);
  /// So far. They push what stands outside of them, or stop where it cannot be pushed.
  void open_fingers(double opening);
  std::optional<Contact> contact_when_open(double opening);
  /// @param across the way that the fingers go
  bool push_outwards(const std::string& thing, const Point3& across);
  void count_push(const std::string& thing);
  void grasp(const WorldThing& thing);
  void lose();
  void stop_at_contact(const Contact& contact);
  void stop(std::string fault);
  Pose tool() const;
  CollisionChecker& checker();

  ArmModel arm_;
  TableWorld world_;
  ArmBodyOptions options_;
  MotionReference reference_;
  Configuration positions_;
  Configuration speeds_;
  double opening_;
  double wanted_opening_;
  bool pushes_ = false;
  std::int64_t steps_ = 0;
  /// Time until which the command holds.
  std::chrono::microseconds commanded_until_{0};
  std::string fault_;
  std::string fault_joint_;
  std::int64_t motion_ = 0;
  /// Each joint comes to rest as fast as it can, since one of them does not follow the motion.
  bool brakes_ = false;
  std::optional<std::size_t> stuck_;
  std::mt19937_64 random_;
  /// Thing that the fingers have slipped off; they do not touch it before they open.
  std::string slipped_;
  /// Step at which the thing is lost.
  std::optional<std::int64_t> loses_at_;
  std::int64_t collisions_ = 0;
  std::string collision_;
  /// Thing between the fingers while they open.
  std::string let_go_;
  /// Thing that opening fingers have pushed in this motion.
  std::string pushed_;
  std::int64_t missed_ = 0;
  std::int64_t dropped_ = 0;
  double moved_ = 0;
  /// Seconds since the last command expired, while joints still move; and most of that so far.
  double uncommanded_ = 0;
  double longest_uncommanded_ = 0;
  std::uint64_t changes_ = 1;
  /// Made anew when the scene or the opening has changed.
  std::optional<CollisionChecker> checker_;
};

} // namespace castor::manipulation
