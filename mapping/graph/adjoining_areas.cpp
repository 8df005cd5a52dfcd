#include "castor/mapping/graph/adjoining_areas.hpp"

#include <algorithm>
#include <map>

namespace castor::mapping {

std::set<std::pair<std::int64_t, std::int64_t>>
adjoining_areas(const std::vector<GraphNode>& nodes, const std::vector<GraphEdge>& edges) {
  std::map<std::int64_t, const GraphNode*> known;
  for (const auto& x : nodes)
    known[x.id] = &x;
  std::set<std::pair<std::int64_t, std::int64_t>> result;
  const auto note = [&](std::int64_t a, std::int64_t b) {
    if (a != b)
      result.insert(std::minmax(a, b));
  };
  // The areas that each gateway leads to.
  std::map<std::int64_t, std::set<std::int64_t>> sides;
  const auto note_side = [&](const GraphNode& gateway, const GraphNode& place) {
    if (gateway.kind == NodeKind::gateway && place.area >= 0)
      sides[gateway.id].insert(place.area);
  };
  for (const auto& x : edges) {
    const auto a = known.find(x.a);
    const auto b = known.find(x.b);
    if (a == known.end() || b == known.end())
      continue;
    note_side(*a->second, *b->second);
    note_side(*b->second, *a->second);
    if (a->second->area >= 0 && b->second->area >= 0)
      note(a->second->area, b->second->area);
  }
  for (const auto& [gateway, areas] : sides)
    for (const auto a : areas)
      for (const auto b : areas)
        note(a, b);
  return result;
}

} // namespace castor::mapping
