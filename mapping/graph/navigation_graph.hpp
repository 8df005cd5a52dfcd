#pragma once

#include "castor/mapping/graph/types.hpp"

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace castor::mapping {

/// Numbers of the two nodes of an edge, the lower first.
using EdgeKey = std::pair<std::int64_t, std::int64_t>;
EdgeKey edge_key(std::int64_t a, std::int64_t b);

/// Entries that are to be written, or deleted where the graph has them no more.
struct GraphChanges {
  std::set<std::int64_t> nodes;
  std::set<EdgeKey> edges;
  std::set<std::int64_t> areas;

  bool empty() const { return nodes.empty() && edges.empty() && areas.empty(); }
};

struct NavigationGraphOptions {
  /// Changes of positions and costs below this are none, metres; and of headings, radians.
  double tolerance = 0.01;
  double heading_tolerance = 0.02;
  /// An edge that has a clearance of less than `comfort` metres costs up to 1 + `narrowness` times
  /// its length.
  double comfort = 0.5;
  double narrowness = 1;
};

/// Nodes, edges between them, and areas, as the entries have them, and what of it has changed.
class NavigationGraph {
public:
  explicit NavigationGraph(const NavigationGraphOptions& options = {}) : options_(options) {}

  /// What entries say, as after a restart. Edges of nodes that are missing are deleted.
  void restore(const std::vector<GraphNode>& nodes, const std::vector<GraphEdge>& edges,
               const std::vector<Area>& areas);

  const std::map<std::int64_t, GraphNode>& nodes() const { return nodes_; }
  const std::map<EdgeKey, GraphEdge>& edges() const { return edges_; }
  const std::map<std::int64_t, Area>& areas() const { return areas_; }
  /// Nodes that edges lead to.
  const std::set<std::int64_t>& neighbours(std::int64_t node) const;

  /// Adds a node, and returns its id. An id is given once.
  /// @param keyframe moves the node with it; @param robot pose of the robot there
  std::int64_t add(NodeKind kind, const Pose2& pose, std::int64_t keyframe, const Pose2& robot,
                   double width = 0);
  /// With its edges.
  void remove(std::int64_t node);
  /// The gateway turned out to be none.
  void make_place(std::int64_t gateway);
  /// Gives the edges of a node to another one, and removes it.
  void merge(std::int64_t node, std::int64_t into);
  /// Moves a node, and with it the costs of its edges.
  void move(std::int64_t node, const Pose2& pose);
  /// The node moves with this keyframe from now on.
  void anchor(std::int64_t node, std::int64_t keyframe, const Pose2& robot);
  void set_width(std::int64_t node, double width);

  /// An edge that exists stays as it is.
  /// @param clearance of the straight line, metres
  void connect(std::int64_t a, std::int64_t b, double clearance);
  void disconnect(std::int64_t a, std::int64_t b);

  /// An area that somebody has named; ignored without the area.
  void label(std::int64_t area, const std::string& label);

  /// Finds the areas anew, if nodes or edges have changed. Of the areas whose places are connected
  /// now, the oldest stays; of one that is not connected any more, the part that has most of its
  /// places keeps the id.
  void update_areas();

  /// Changes since the last time.
  GraphChanges take_changes() { return std::exchange(changes_, {}); }

private:
  using Component = std::vector<std::int64_t>;

  double factor(double clearance) const;
  void update_cost(const EdgeKey& edge);
  /// 1 for a node in front of the gateway, -1 for one behind.
  int side_of(std::int64_t gateway, std::int64_t node) const;
  std::vector<Component> components() const;
  void assign(const std::vector<Component>& components);
  void summarise(const std::map<std::int64_t, Component>& places);
  void set_area(const Area& area);

  NavigationGraphOptions options_;
  std::map<std::int64_t, GraphNode> nodes_;
  std::map<EdgeKey, GraphEdge> edges_;
  /// Costs by lengths.
  std::map<EdgeKey, double> factors_;
  std::map<std::int64_t, std::set<std::int64_t>> neighbours_;
  std::map<std::int64_t, Area> areas_;
  std::int64_t next_node_ = 0;
  std::int64_t next_area_ = 0;
  bool is_connected_anew_ = false;
  bool has_moved_ = false;
  GraphChanges changes_;
};

} // namespace castor::mapping
