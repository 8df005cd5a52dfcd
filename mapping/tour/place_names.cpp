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
  const auto is_parted = [&](const Point2& a, const Point2& b) {
    return std::ranges::any_of(nodes, [&](const GraphNode& x) {
      const auto half = x.width / 2 + beside;
      const Line2 door{transform(x.pose, {0, -half}), transform(x.pose, {0, half})};
      return x.kind == NodeKind::gateway && cross(door, {a, b});
    });
  };
  std::vector<Named> result;
  std::erase_if(waiting_, [&](const Waiting& x) {
    if (distance(point_of(robot), x.where) > near || is_parted(point_of(robot), x.where) ||
        is_parted(point_of(at->pose), x.where))
      return false;
    result.push_back({at->area, x.name});
    return true;
  });
  return result;
}

} // namespace castor::mapping
