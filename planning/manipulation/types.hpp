#pragma once

#include "castor/actors/component/entry_pointer.hpp"
#include "castor/mapping/geometry/types.hpp"
#include "castor/perception/spatial/types.hpp"
#include "castor/perception/vision/types.hpp"
#include "castor/planning/manipulation/solid.hpp"
#include "castor/wm/values/reflect.hpp"

#include <cstdint>
#include <string>
#include <vector>

/// Actions of an arm, what is said of the one that runs, and what an arm obeys and measures.
/// Metres, radians, seconds.
namespace castor::manipulation {

// -- actions

enum class ManipulationPriority {
  /// After those that wait.
  normal,
  /// Before those that wait and are `normal`, after the one that runs.
  high
};

/// Where a thing is to stand.
struct TablePlace {
  /// Of the thing's middle.
  double x = 0;
  double y = 0;
  /// Any place that is no further from it will do; the nearest that is possible is taken.
  double radius = 0.01;
  /// The thing that it is to stand on; x and y mean nothing then. Unset: the table.
  EntryPointer<vision::SceneObject> on;
  /// Name of the frame of x and y.
  std::string frame = geometry::table_frame;

  friend bool operator==(const TablePlace&, const TablePlace&) = default;
};

/// Action: take a thing and put it somewhere. It has succeeded when vision sees a thing like it
/// there: `Action::became_true` is "seen SUBARCHITECTURE/ID" then, which may be another SceneObject
/// than before.
struct PickAndPlace {
  EntryPointer<vision::SceneObject> what;
  TablePlace to;
  /// It may be put down somewhere on the way, to be held in another way from there on.
  bool may_put_between = false;
  ManipulationPriority priority = ManipulationPriority::normal;
};

/// Action: take a thing, and hold it out of the camera's sight. It has succeeded when vision does
/// not see the thing any more where it was.
struct Pick {
  EntryPointer<vision::SceneObject> what;
  ManipulationPriority priority = ManipulationPriority::normal;
};

/// Action: put down what the gripper holds. As for PickAndPlace, vision has to see it there.
struct Place {
  TablePlace to;
  ManipulationPriority priority = ManipulationPriority::normal;
};

/// Action: push a thing with closed fingers, also one that is too flat or too wide to be grasped,
/// until it is at least so far from where it was; off everything else, on the table and where the
/// arm reaches. It has succeeded as PickAndPlace has.
struct PushAside {
  EntryPointer<vision::SceneObject> what;
  double distance = 0.1;
  /// Direction in the table's frame, exactly so far; any, if both are 0.
  double x = 0;
  double y = 0;
  ManipulationPriority priority = ManipulationPriority::normal;
};

/// Action: go where the arm rests, out of the camera's sight, with what it holds.
struct GoHome {
  ManipulationPriority priority = ManipulationPriority::normal;
};

/// Action: stand at once; the actions that run and wait are cancelled. What is held stays held.
struct StopArm {};

/// Action: stand until ResumeArm; the action that runs goes on then.
struct PauseArm {};

/// Action: go on after PauseArm.
struct ResumeArm {};

/// A call: could a thing be taken and put where another one is, perhaps with a stop on the way, if
/// all others were gone? The reply is of the same type.
struct ExchangeQuery {
  EntryPointer<vision::SceneObject> what;
  EntryPointer<vision::SceneObject> at;
  /// In the reply: it is not known while the arm moves or holds something.
  bool is_known = false;
  /// Why it could not, a clause; empty if it could.
  std::string reason;
};

/// A call: how could a thing be taken and put at points of the table, if nothing else stood on it?
/// The reply is of the same type.
struct LandingQuery {
  EntryPointer<vision::SceneObject> what;
  /// In the table's frame, metres.
  std::vector<spatial::GroundPoint> points;
  /// Whether places between are looked for, where it cannot be put there directly.
  bool may_put_between = false;
  /// In the reply: direct, by_stop or none for each point; empty while the arm moves or holds
  /// something, or does not see the thing.
  std::vector<spatial::Reach> reach = {};
};

enum class ManipulationStatus {
  idle,
  /// Looks at what vision says is on the table.
  looking,
  planning,
  moving,
  grasping,
  releasing,
  pushing,
  paused,
  /// Waits until vision has looked at the result.
  confirming,
  succeeded,
  failed,
  cancelled
};

/// Entry: what an ArmExecutor does. Its id is the component's name; it is overwritten.
struct Manipulation {
  /// When that was, microseconds since the system began.
  std::int64_t time = 0;
  ManipulationStatus status = ManipulationStatus::idle;
  /// The action, for people: "put the blue sphere at 0.10 0.05".
  std::string task;
  /// What it does now, for people: "lifts the blue sphere".
  std::string step;
  /// The thing as it was seen before the action, and as it was seen after it.
  EntryPointer<vision::SceneObject> what;
  EntryPointer<vision::SceneObject> seen;
  /// Description of what the gripper holds: "the blue sphere"; empty if it holds nothing.
  std::string holds;
  /// The same thing as it was seen before it was taken; unset if that is not known.
  EntryPointer<vision::SceneObject> held;
  /// Why it failed, was cancelled, or tried again.
  std::string reason;
  /// Things that are in the way, by their descriptions; without them it would be possible.
  std::vector<std::string> in_way;
  /// Ids of their SceneObjects, in the same order.
  std::vector<std::string> in_way_ids;
  /// Names of the arm's joints that do not move any more.
  std::vector<std::string> still_joints;
  /// Numbers of this action: motions planned, grasps that were tried, and time spent on planning.
  std::int64_t plans = 0;
  std::int64_t tries = 0;
  double planning_time = 0;
};

/// Entry: what an ArmExecutor has grasped, or is about to grasp, or has let go and vision has not
/// seen there yet, so that its successor knows what the gripper holds or is around. Its id is the
/// component's name and " holds".
struct HeldThing {
  EntryPointer<vision::SceneObject> what;
  /// Description, and as vision names it.
  std::string name;
  std::string colour;
  std::string shape;
  Solid solid;
  /// In the tool's frame; in the arm's, if it was let go.
  geometry::Pose pose;
  double uncertainty = 0;
  double higher = 0;
  bool let_go = false;
};

CASTOR_REFLECT_ENUM(ManipulationPriority, normal, high)
CASTOR_REFLECT(TablePlace, x, y, radius, on, frame)
CASTOR_REFLECT(PickAndPlace, what, to, may_put_between, priority)
CASTOR_REFLECT(Pick, what, priority)
CASTOR_REFLECT(Place, to, priority)
CASTOR_REFLECT(PushAside, what, distance, x, y, priority)
CASTOR_REFLECT(GoHome, priority)
CASTOR_REFLECT(StopArm)
CASTOR_REFLECT(PauseArm)
CASTOR_REFLECT(ResumeArm)
CASTOR_REFLECT(ExchangeQuery, what, at, is_known, reason)
CASTOR_REFLECT(LandingQuery, what, points, may_put_between, reach)
CASTOR_REFLECT_ENUM(ManipulationStatus, idle, looking, planning, moving, grasping, releasing,
                    pushing, paused, confirming, succeeded, failed, cancelled)
CASTOR_REFLECT(Manipulation, time, status, task, step, what, seen, holds, held, reason, in_way,
               in_way_ids, still_joints, plans, tries, planning_time)
CASTOR_REFLECT(HeldThing, what, name, colour, shape, solid, pose, uncertainty, higher, let_go)

// -- the arm

/// Entry: who holds a lease of it may command the arm (`SimulatedArm --lease`).
struct ArmSeat {
  /// Component that sits in it.
  std::string commander;

  friend bool operator==(const ArmSeat&, const ArmSeat&) = default;
};

/// Command: go on along a motion. It has the part of the motion that comes next; an arm that gets
/// no other command comes to rest on it.
struct ArmCommand {
  /// Another number is another motion, which begins where the arm is.
  std::int64_t motion = 0;
  /// Time of the first configuration since the motion began, and between two of them.
  double begin = 0;
  double interval = 0.05;
  /// Configurations, one after the other: a number for each joint. The last is rest.
  std::vector<double> positions;
  /// What the gripper is to open to.
  double opening = 0;
  /// Whether the gripper may push things on the table.
  bool pushes = false;
};

/// What the arm measures, and how far it is.
struct ArmState {
  /// Microseconds since the system began.
  std::int64_t time = 0;
  std::vector<double> positions;
  std::vector<double> speeds;
  /// Of the gripper.
  double opening = 0;
  /// The fingers press on something.
  bool holds = false;
  /// The motion that it is on, 0 for none, and the time on it that it has come to.
  std::int64_t motion = 0;
  double motion_time = 0;
  /// Joints and fingers stand.
  bool rests = true;
  /// Why it does not go on: a contact, or a joint that does not follow. Holds until the next
  /// motion.
  std::string fault;
  /// Name of the joint that does not follow, if it is that.
  std::string fault_joint;
};

/// Thing of a simulated table as it really is, in the table's frame.
struct TrueThing {
  std::string name;
  geometry::Pose pose;
  /// What it stands on: "the table", another thing, "the floor", or "the gripper".
  std::string support;
};

/// The truth about a simulated arm and its table, for evaluation only.
struct ArmStatus {
  std::int64_t time = 0;
  std::vector<TrueThing> things;
  /// Contacts of the arm so far, and the last in words.
  std::int64_t collisions = 0;
  std::string collision;
  /// Injected faults so far.
  std::int64_t missed = 0;
  std::int64_t dropped = 0;
  /// Way of the joints so far, radians.
  double moved = 0;
  /// Longest time so far that joints moved after the last command had expired, seconds.
  double uncommanded = 0;
};

CASTOR_REFLECT(ArmSeat, commander)
CASTOR_REFLECT(ArmCommand, motion, begin, interval, positions, opening, pushes)
CASTOR_REFLECT(ArmState, time, positions, speeds, opening, holds, motion, motion_time, rests, fault,
               fault_joint)
CASTOR_REFLECT(TrueThing, name, pose, support)
CASTOR_REFLECT(ArmStatus, time, things, collisions, collision, missed, dropped, moved, uncommanded)

} // namespace castor::manipulation
