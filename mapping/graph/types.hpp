#pragma once

#include "castor/mapping/planar/types.hpp"
#include "castor/wm/values/reflect.hpp"

#include <cstdint>
#include <string>

/// Entry types of the navigation graph. Metres and radians, in the frame of the map.
namespace castor::mapping {

enum class NodeKind {
  /// Free space where the robot has been.
  place,
  /// The middle of a door.
  gateway
};

/// Entry "node-ID": a place to drive to.
struct GraphNode {
  std::int64_t id = 0;
  NodeKind kind = NodeKind::place;
  /// A gateway faces the way through, in one of the two directions.
  Pose2 pose;
  /// Between the posts of a gateway; 0 for a place.
  double width = 0;
  /// Area that the place belongs to; -1 for a gateway, which is between areas.
  std::int64_t area = -1;
  /// Number of the keyframe that it moves with when the pose graph is corrected, and its pose on
  /// the robot at that keyframe.
  std::int64_t keyframe = 0;
  Pose2 on_keyframe;

  friend bool operator==(const GraphNode&, const GraphNode&) = default;
};

/// Entry "edge-A-B", A < B: there is a free way between two nodes, in both directions.
struct GraphEdge {
  std::int64_t a = 0;
  std::int64_t b = 0;
  /// Length, metres; more where it is narrow.
  double cost = 0;

  friend bool operator==(const GraphEdge&, const GraphEdge&) = default;
};

/// Entry "area-ID": places that are connected without going through a gateway, such as a room.
struct Area {
  std::int64_t id = 0;
  /// Given by people; empty without.
  std::string label;
  /// Area that this one turned out to be a part of, or -1. Such an area has no places, and its
  /// entry stays, for those who refer to it.
  std::int64_t merged_into = -1;
  /// Number of its places, and their centroid.
  std::int64_t places = 0;
  double x = 0;
  double y = 0;

  friend bool operator==(const Area&, const Area&) = default;
};

/// Entry "robot-area": where the robot is in the graph. There is one, which is overwritten.
struct RobotArea {
  /// Node that the robot was at last, and the area of it or of the last place before; -1 without.
  std::int64_t node = -1;
  std::int64_t area = -1;
  /// Number of the newest keyframe that is in the graph.
  std::int64_t keyframe = -1;

  friend bool operator==(const RobotArea&, const RobotArea&) = default;
};

CASTOR_REFLECT_ENUM(NodeKind, place, gateway)
CASTOR_REFLECT(GraphNode, id, kind, pose, width, area, keyframe, on_keyframe)
CASTOR_REFLECT(GraphEdge, a, b, cost)
CASTOR_REFLECT(Area, id, label, merged_into, places, x, y)
CASTOR_REFLECT(RobotArea, node, area, keyframe)

} // namespace castor::mapping
