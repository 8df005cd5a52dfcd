#pragma once

#include "castor/mapping/planar/types.hpp"
#include "castor/wm/values/reflect.hpp"

#include <cstdint>
#include <string>
#include <vector>

/// Actions that move the robot, and what is said of the one that runs. Places are in the map frame;
/// metres, radians.
namespace castor::mapping {

enum class MovementPriority {
  /// After those that wait.
  normal,
  /// Before those that wait and are `normal`, after the one that runs.
  high,
  /// At once: the one that runs and those that wait are cancelled.
  urgent
};

/// Action: go to a place.
struct GoToPlace {
  double x = 0;
  double y = 0;
  /// Direction to face there, if `has_heading`.
  double heading = 0;
  bool has_heading = false;
  /// Whether it goes from node to node of the navigation graph, as far as that leads.
  bool along_graph = false;
  MovementPriority priority = MovementPriority::normal;
};

/// Action: go to a node of the navigation graph.
struct GoToNode {
  /// `GraphNode::id`.
  std::int64_t node = 0;
  /// As of GoToPlace.
  bool along_graph = false;
  MovementPriority priority = MovementPriority::normal;
};

/// Action: go into an area of the navigation graph, such as a room: to its place that is nearest to
/// its middle. An area that was merged into another one stands for that.
struct GoToArea {
  /// `Area::id`.
  std::int64_t area = 0;
  /// As of GoToPlace.
  bool along_graph = false;
  MovementPriority priority = MovementPriority::normal;
  /// `Area::label`, in place of its id; empty: none. Of several areas, the one that has most places.
  std::string label = {};
};

/// Action: go near an object, and face it.
struct GoToObject {
  /// Its place.
  double x = 0;
  double y = 0;
  /// Greatest distance of the robot's middle from there.
  double distance = 1;
  MovementPriority priority = MovementPriority::normal;
};

/// Action: follow a person at a distance until it is cancelled. It fails if the person is lost or
/// cannot be reached.
struct FollowPerson {
  /// `Person::id`; 0: the one who is nearest to the robot.
  std::int64_t person = 0;
  /// Between the middles of robot and person, metres.
  double distance = 1.2;
  MovementPriority priority = MovementPriority::normal;
};

/// Action: turn on the spot, by more than a full turn too.
struct TurnBy {
  double angle = 0;
  MovementPriority priority = MovementPriority::normal;
};

/// Action: turn on the spot to a heading in the map frame, the shorter way round.
struct TurnTo {
  double heading = 0;
  MovementPriority priority = MovementPriority::normal;
};

/// Action: stand. It is always urgent.
struct StopMoving {
  MovementPriority priority = MovementPriority::urgent;
};

enum class MovementStatus {
  idle,
  planning,
  moving,
  waiting,
  recovering,
  arrived,
  failed,
  cancelled
};

/// Entry: what a Navigator does. Its id is the component's name; it is overwritten.
struct Movement {
  /// When that was, microseconds since the system began.
  std::int64_t time = 0;
  MovementStatus status = MovementStatus::idle;
  /// The action, for people: "go to 2.50 5.10".
  std::string task;
  Pose2 goal;
  /// Waypoints, in their order; each faces the next.
  std::vector<Pose2> path;
  /// Way driven along the path, and its length.
  double done = 0;
  double length = 0;
  /// Why the robot stands; empty if it moves.
  std::string waits_for;
  /// Why it failed or was cancelled.
  std::string reason;
  /// Time of the newest plan, seconds.
  double planning_time = 0;
  /// Numbers of this action: plans, recoveries from a stall, and time that it stood, seconds.
  std::int64_t plans = 0;
  std::int64_t recoveries = 0;
  double waited = 0;

  friend bool operator==(const Movement&, const Movement&) = default;
};

CASTOR_REFLECT_ENUM(MovementPriority, normal, high, urgent)
CASTOR_REFLECT(GoToPlace, x, y, heading, has_heading, along_graph, priority)
CASTOR_REFLECT(GoToNode, node, along_graph, priority)
CASTOR_REFLECT(GoToArea, area, along_graph, priority, label)
CASTOR_REFLECT(GoToObject, x, y, distance, priority)
CASTOR_REFLECT(FollowPerson, person, distance, priority)
CASTOR_REFLECT(TurnBy, angle, priority)
CASTOR_REFLECT(TurnTo, heading, priority)
CASTOR_REFLECT(StopMoving, priority)
CASTOR_REFLECT_ENUM(MovementStatus, idle, planning, moving, waiting, recovering, arrived, failed,
                    cancelled)
CASTOR_REFLECT(Movement, time, status, task, goal, path, done, length, waits_for, reason,
               planning_time, plans, recoveries, waited)

} // namespace castor::mapping
