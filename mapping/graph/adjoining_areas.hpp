#pragma once

#include "castor/mapping/graph/types.hpp"

#include <cstdint>
#include <set>
#include <utility>
#include <vector>

namespace castor::mapping {

/// Pairs of different areas between which a way leads, through a gateway or from place to place;
/// the smaller id first.
std::set<std::pair<std::int64_t, std::int64_t>>
adjoining_areas(const std::vector<GraphNode>& nodes, const std::vector<GraphEdge>& edges);

} // namespace castor::mapping
