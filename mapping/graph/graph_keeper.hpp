#pragma once

#include "castor/mapping/graph/gateway_tracker.hpp"
#include "castor/mapping/graph/moving_beams.hpp"
#include "castor/mapping/graph/navigation_graph.hpp"
#include "castor/mapping/graph/room_segments.hpp"
#include "castor/mapping/graph/scan_clearance.hpp"
#include "castor/mapping/graph/types.hpp"

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <vector>

namespace castor::mapping {

struct GraphOptions {
  /// Distance between neighbouring places along the path of the robot, metres.
  double spacing = 1;
  /// A straight line is a free way if nothing is nearer to it than this, metres.
  double free_way = 0.2;
  /// A gateway that the robot has not passed is connected to places up to this far, metres.
  double gateway_reach = 2.5;
  DoorOptions doors;
  GatewayOptions gateways;
  MovingBeamsOptions moving;
  NavigationGraphOptions graph;
};

/// Makes the navigation graph of the keyframes of a robot's path.
class GraphKeeper {
public:
  using ScanPtr = std::shared_ptr<const LaserScan>;

  explicit GraphKeeper(const GraphOptions& options = {});

  /// Goes on from the entries of one before. The keyframes are to be added again; those up to
  /// `position.keyframe` are in the graph already.
  void restore(const std::vector<GraphNode>& nodes, const std::vector<GraphEdge>& edges,
               const std::vector<Area>& areas, const RobotArea& position);

  /// Adds a keyframe, by increasing numbers.
  /// @param local_pose in the front end's frame, which has no jumps
  /// @param robot pose in the map
  void add(std::int64_t keyframe, const ScanPtr& scan, const Pose2& local_pose, const Pose2& robot);

  /// The keyframe exists no more; nodes that moved with it move with another one.
  void remove(std::int64_t keyframe);

  /// The pose of a keyframe was corrected. After all of them, finish() moves the nodes.
  void correct(std::int64_t keyframe, const Pose2& robot);

  /// Uses a division of the map into rooms as a second source: a gateway at an opening between two
  /// segments needs one view only; one within a segment most of the possible views, and that the
  /// robot has passed it. It divides no areas by itself. finish() has to follow.
  void reconcile(const RoomSegments& rooms);

  /// To be called after keyframes were added, removed or corrected: updates gateways and areas.
  void finish();

  void label(std::int64_t area, const std::string& label) { graph_.label(area, label); }

  const NavigationGraph& graph() const { return graph_; }
  GraphChanges take_changes() { return graph_.take_changes(); }
  /// Where the robot is in it.
  RobotArea position() const { return position_; }

private:
  /// A gateway of the graph.
  struct Door {
    std::int64_t node = -1;
    Pose2 pose;
    double width = 0;
  };

  void move_nodes();
  void update_gateways();
  bool counts(const Gateway& gateway) const;
  bool is_passed(const Gateway& gateway) const;
  void add_gateway(const Gateway& gateway);
  void drop_gateway(std::int64_t gateway);
  void split_edges(const Door& door);
  void connect_gateways(const Pose2& robot);
  void go(const Pose2& from, const Pose2& to, std::int64_t keyframe);
  void arrive(std::int64_t node);
  void connect_way(std::int64_t a, std::int64_t b);
  void connect_driven(std::int64_t a, std::int64_t b);
  void drop_detours(std::int64_t gateway, std::int64_t place);
  bool is_free(const Point2& a, const Point2& b) const;
  bool goes_through_wall(const Line2& line, std::int64_t except) const;
  std::optional<std::int64_t> nearest_place(const Pose2& robot, double within) const;
  bool has_neighbour_on_side(const Door& door, const Point2& of) const;
  std::int64_t nearest_keyframe(const Pose2& pose) const;

  GraphOptions options_;
  NavigationGraph graph_;
  GatewayTracker tracker_;
  MovingBeams moving_;
  ScanClearance clearance_;
  /// In the map, by number of keyframe.
  std::map<std::int64_t, Pose2> poses_;
  /// By gateways of the tracker.
  std::map<std::int64_t, Door> doors_;
  RobotArea position_;
  bool is_corrected_ = false;
};

} // namespace castor::mapping
