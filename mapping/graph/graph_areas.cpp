// How NavigationGraph finds its areas.

#include "castor/mapping/graph/navigation_graph.hpp"
#include "castor/mapping/planar/poses.hpp"

#include <algorithm>
#include <cstddef>
#include <set>
#include <utility>
#include <vector>

namespace castor::mapping {

void NavigationGraph::update_areas() {
  if (!is_connected_anew_ && !has_moved_)
    return;
  auto found = components();
  if (is_connected_anew_)
    assign(found);
  std::map<std::int64_t, Component> places;
  for (auto& x : found)
    places[nodes_.at(x.front()).area] = x;
  summarise(places);
  is_connected_anew_ = false;
  has_moved_ = false;
}

int NavigationGraph::side_of(std::int64_t gateway, std::int64_t node) const {
  const auto& at = nodes_.at(node).pose;
  return transform(inverse(nodes_.at(gateway).pose), {at.x, at.y}).x >= 0 ? 1 : -1;
}

/// Places that are connected without going through a gateway: those that a gateway is connected
/// with on the same side are. Each component is by increasing ids, and those come first that have
/// the lowest ones.
std::vector<NavigationGraph::Component> NavigationGraph::components() const {
  // A node, and the side of a gateway; 0 for a place.
  using Stop = std::pair<std::int64_t, int>;
  const auto stop_at = [this](std::int64_t node, std::int64_t from) {
    return Stop{node, nodes_.at(node).kind == NodeKind::gateway ? side_of(node, from) : 0};
  };
  std::vector<Component> result;
  std::set<Stop> done;
  for (auto& [id, node] : nodes_) {
    if (node.kind == NodeKind::gateway || !done.insert({id, 0}).second)
      continue;
    std::vector<Stop> stops{{id, 0}};
    Component places;
    for (std::size_t i = 0; i < stops.size(); ++i) {
      const auto [at, side] = stops[i];
      if (side == 0)
        places.push_back(at);
      for (auto other : neighbours(at))
        if (side == 0 || side_of(at, other) == side)
          if (auto next = stop_at(other, at); done.insert(next).second)
            stops.push_back(next);
    }
    std::ranges::sort(places);
    result.push_back(std::move(places));
  }
  return result;
}

void NavigationGraph::assign(const std::vector<Component>& components) {
  // How many places of an area are in a component.
  std::map<std::int64_t, std::map<std::size_t, std::size_t>> shares;
  for (std::size_t i = 0; i < components.size(); ++i)
    for (auto node : components[i])
      if (nodes_.at(node).area >= 0)
        ++shares[nodes_.at(node).area][i];
  std::vector<std::int64_t> ids(components.size(), -1);
  std::map<std::int64_t, std::size_t> successors;
  // The oldest first, so that they stay.
  for (auto& [area, parts] : shares) {
    const auto largest =
      std::ranges::max_element(parts, [](auto& a, auto& b) { return a.second < b.second; });
    successors[area] = largest->first;
    if (ids[largest->first] < 0)
      ids[largest->first] = area;
  }
  for (std::size_t i = 0; i < components.size(); ++i) {
    if (ids[i] < 0)
      ids[i] = next_area_++;
    areas_.try_emplace(ids[i]).first->second.id = ids[i];
    for (auto node : components[i]) {
      auto& x = nodes_.at(node);
      if (x.area == ids[i])
        continue;
      x.area = ids[i];
      changes_.nodes.insert(node);
    }
  }
  for (auto& [id, node] : nodes_) {
    if (node.kind != NodeKind::gateway || node.area < 0)
      continue;
    node.area = -1;
    changes_.nodes.insert(id);
  }
  for (auto& [area, component] : successors) {
    const auto into = ids[component];
    if (into == area)
      continue;
    auto merged = areas_[area];
    merged.id = area;
    merged.merged_into = into;
    merged.places = 0;
    set_area(merged);
    for (auto& [id, x] : areas_) {
      if (x.merged_into != area || id == into)
        continue;
      x.merged_into = into;
      changes_.areas.insert(id);
    }
    if (areas_.at(into).label.empty() && !merged.label.empty()) {
      areas_.at(into).label = merged.label;
      changes_.areas.insert(into);
    }
  }
}

void NavigationGraph::summarise(const std::map<std::int64_t, Component>& places) {
  for (auto& [id, members] : places) {
    auto x = areas_.at(id);
    x.merged_into = -1;
    x.places = static_cast<std::int64_t>(members.size());
    Point2 sum;
    for (auto node : members) {
      sum.x += nodes_.at(node).pose.x;
      sum.y += nodes_.at(node).pose.y;
    }
    const auto count = static_cast<double>(members.size());
    if (distance(Point2{x.x, x.y}, {sum.x / count, sum.y / count}) >= options_.tolerance) {
      x.x = sum.x / count;
      x.y = sum.y / count;
    }
    set_area(x);
  }
  // All places of an area that was merged into no other were removed.
  for (auto x = areas_.begin(); x != areas_.end();) {
    if (x->second.merged_into >= 0 || places.contains(x->first)) {
      ++x;
      continue;
    }
    changes_.areas.insert(x->first);
    x = areas_.erase(x);
  }
}

void NavigationGraph::set_area(const Area& area) {
  auto& x = areas_[area.id];
  if (x == area)
    return;
  x = area;
  changes_.areas.insert(area.id);
}

} // namespace castor::mapping
