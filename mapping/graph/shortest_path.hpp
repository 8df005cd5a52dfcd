#pragma once

#include "castor/mapping/graph/types.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace castor::mapping {

/// A way over the graph.
struct GraphWay {
  /// Nodes from the first to the last; empty if there is no way.
  std::vector<std::int64_t> nodes;
  double cost = 0;
};

/// The way of the lowest cost (E. W. Dijkstra, "A note on two problems in connexion with graphs",
/// 1959).
GraphWay shortest_way(std::span<const GraphEdge> edges, std::int64_t from, std::int64_t to);

} // namespace castor::mapping
