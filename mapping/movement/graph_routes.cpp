#include "castor/mapping/movement/graph_routes.hpp"

#include "castor/mapping/graph/shortest_path.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <set>
#include <string>

namespace castor::mapping {

namespace {

/// Nodes that may be the first or the last of a way: so many are looked at.
constexpr std::size_t candidates = 4;
/// Ways beside the graph count so many times their length.
constexpr double beside_graph = 3;

Point2 place_of(const GraphNode& x) {
  return {x.pose.x, x.pose.y};
}

} // namespace

const GraphNode* GraphRoutes::find(std::int64_t id) const {
  const auto x = std::ranges::find(nodes_, id, &GraphNode::id);
  return x == nodes_.end() ? nullptr : &*x;
}

GraphRoutes::Place GraphRoutes::node(std::int64_t id) const {
  if (const auto* x = find(id))
    return {place_of(*x), {}};
  return {{},
          fmt::format("the navigation graph has no node {}; it has {} nodes: see the entries "
                      "node-ID of the map",
                      id, nodes_.size())};
}

GraphRoutes::Place GraphRoutes::area(std::int64_t id) const {
  auto x = std::ranges::find(areas_, id, &Area::id);
  // No longer than there are areas, should they point to one another.
  for (std::size_t i = 0; x != areas_.end() && x->merged_into >= 0 && i < areas_.size(); ++i)
    x = std::ranges::find(areas_, x->merged_into, &Area::id);
  const GraphNode* nearest = nullptr;
  double least = std::numeric_limits<double>::infinity();
  for (const auto& node : nodes_) {
    if (x == areas_.end() || node.kind != NodeKind::place || node.area != x->id)
      continue;
    if (const double away = distance(place_of(node), {x->x, x->y}); away < least) {
      least = away;
      nearest = &node;
    }
  }
  if (nearest)
    return {place_of(*nearest), {}};
  return {{},
          fmt::format("the navigation graph has no place in an area {}; see the entries area-ID of "
                      "the map",
                      id)};
}

GraphRoutes::Place GraphRoutes::area_named(const std::string& label) const {
  const Area* best = nullptr;
  std::set<std::string> names;
  for (const auto& x : areas_) {
    if (x.merged_into >= 0 || x.label.empty())
      continue;
    names.insert(x.label);
    if (x.label == label && (!best || x.places > best->places))
      best = &x;
  }
  if (best)
    return area(best->id);
  const auto known = names.empty()
                       ? std::string{"none has a name; overwrite Area.label to give one"}
                       : fmt::format("there are: {}", fmt::join(names, ", "));
  return {{}, fmt::format("no area of the navigation graph is called {}; {}", label, known)};
}

std::vector<std::pair<const GraphNode*, double>> GraphRoutes::near(const Point2& place,
                                                                   const WayLength& way) const {
  std::vector<const GraphNode*> all;
  for (const auto& x : nodes_)
    all.push_back(&x);
  const auto some = std::min(candidates, all.size());
  std::ranges::partial_sort(all, all.begin() + static_cast<std::ptrdiff_t>(some), {},
                            [&](auto* x) { return distance(place_of(*x), place); });
  all.resize(some);
  std::vector<std::pair<const GraphNode*, double>> result;
  for (const auto* x : all)
    if (const double length = way(place, place_of(*x)); std::isfinite(length))
      result.emplace_back(x, length);
  return result;
}

std::vector<Point2> GraphRoutes::between(const Point2& from, const Point2& to,
                                         const WayLength& way) const {
  std::vector<std::int64_t> best;
  double least = std::numeric_limits<double>::infinity();
  const auto last = near(to, way);
  for (const auto& [first, there] : near(from, way))
    for (const auto& [end, back] : last) {
      auto x = shortest_way(edges_, first->id, end->id);
      const double cost = x.cost + beside_graph * (there + back);
      if (x.nodes.empty() || cost >= least)
        continue;
      least = cost;
      best = std::move(x.nodes);
    }
  std::vector<Point2> result;
  for (const auto id : best)
    result.push_back(place_of(*find(id)));
  return result;
}

std::vector<Point2> GraphRoutes::gateways() const {
  std::vector<Point2> result;
  for (const auto& x : nodes_)
    if (x.kind == NodeKind::gateway)
      result.push_back(place_of(x));
  return result;
}

} // namespace castor::mapping
