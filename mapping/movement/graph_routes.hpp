#pragma once

#include "castor/mapping/graph/types.hpp"
#include "castor/mapping/planar/poses.hpp"

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace castor::mapping {

/// Ways over a navigation graph, for the robot that is to follow it.
class GraphRoutes {
public:
  GraphRoutes(std::vector<GraphNode> nodes, std::vector<GraphEdge> edges, std::vector<Area> areas)
    : nodes_(std::move(nodes)), edges_(std::move(edges)), areas_(std::move(areas)) {}

  struct Place {
    Point2 place;
    /// Why there is none; empty if there is one.
    std::string reason;
  };

  /// Where a node is.
  Place node(std::int64_t id) const;

  /// The place of an area, or of the one that it was merged into, that is nearest to its middle.
  Place area(std::int64_t id) const;

  /// The same of the area of that name that has most places.
  Place area_named(const std::string& label) const;

  /// Length of a way that the robot can drive, infinite if there is none.
  using WayLength = std::function<double(const Point2& from, const Point2& to)>;

  /// Nodes on the way from one place to another, by the smallest sum of the cost of edges and of
  /// three times the ways to the first node and from the last. Empty if the graph does not lead
  /// there.
  std::vector<Point2> between(const Point2& from, const Point2& to, const WayLength& way) const;

  /// Middles of doors.
  std::vector<Point2> gateways() const;

private:
  const GraphNode* find(std::int64_t id) const;
  /// Those nearest to the place as the crow flies that can be driven to, and the ways there.
  std::vector<std::pair<const GraphNode*, double>> near(const Point2& place,
                                                        const WayLength& way) const;

  std::vector<GraphNode> nodes_;
  std::vector<GraphEdge> edges_;
  std::vector<Area> areas_;
};

} // namespace castor::mapping
