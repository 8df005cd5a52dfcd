#include "castor/mapping/tour/place_names.hpp"

#include "castor/mapping/graph/segments.hpp"

#include <algorithm>

namespace castor::mapping {

namespace {

/// Farther away, the robot may not know what is in between; metres.
constexpr double near = 2.5;
/// Of the wall beside a door, metres.
constexpr double beside = 0.4;

Point2 point_of(const Pose2& x) {
  return {x.x, x.y};
}

/// Whether there is a door between them.
bool are_parted(const Point2& a, const Point2& b, const std::vector<GraphNode>& nodes) {
  return std::ranges::any_of(nodes, [&](const GraphNode& x) {
    const auto half = x.width / 2 + beside;
    const Line2 door{transform(x.pose, {0, -half}), transform(x.pose, {0, half})};
    return x.kind == NodeKind::gateway && cross(door, {a, b});
  });
}

} // namespace

void PlaceNames::add(const std::string& name, const Point2& where) {
  waiting_.push_back({name, where});
}

std::vector<PlaceNames::Named> PlaceNames::take_known(const Pose2& robot, const RobotArea& position,
                                                      const std::vector<GraphNode>& nodes) {
  const auto at = std::ranges::find(nodes, position.node, &GraphNode::id);
  // In a door, or not in the graph.
  if (at == nodes.end() || at->area < 0)
    return {};
  std::vector<Named> result;
  std::erase_if(waiting_, [&](const Waiting& x) {
    if (distance(point_of(robot), x.where) > near || are_parted(point_of(robot), x.where, nodes) ||
        are_parted(point_of(at->pose), x.where, nodes))
      return false;
    result.push_back({at->area, x.name});
    std::erase_if(given_, [&](const Given& y) { return y.named.area == at->area; });
    given_.push_back({result.back(), at->id, x.where});
    return true;
  });
  return result;
}

std::vector<PlaceNames::Moved> PlaceNames::take_moved(const std::vector<GraphNode>& nodes) {
  std::vector<Moved> result;
  for (auto& x : given_) {
    const auto far = [&](const GraphNode& node) { return distance(point_of(node.pose), x.where); };
    const auto is_beside = [&](const GraphNode& node) {
      return node.area >= 0 && !are_parted(point_of(node.pose), x.where, nodes);
    };
    auto node = std::ranges::find(nodes, x.node, &GraphNode::id);
    if (node == nodes.end() || !is_beside(*node)) {
      // Other places of the area may be beside it behind a wall.
      double nearest = near;
      for (auto i = nodes.begin(); i != nodes.end(); ++i)
        if (i->area != x.named.area && is_beside(*i) && far(*i) < nearest) {
          nearest = far(*i);
          node = i;
        }
      if (node == nodes.end() || !is_beside(*node))
        continue;
      x.node = node->id;
    }
    if (node->area == x.named.area)
      continue;
    result.push_back({x.named.area, {node->area, x.named.name}});
    x.named.area = node->area;
  }
  return result;
}

} // namespace castor::mapping
