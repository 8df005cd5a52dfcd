#include "castor/mapping/graph/navigation_graph.hpp"

#include "castor/mapping/planar/poses.hpp"

#include <algorithm>
#include <cmath>

namespace castor::mapping {

EdgeKey edge_key(std::int64_t a, std::int64_t b) {
  return std::minmax(a, b);
}

void NavigationGraph::restore(const std::vector<GraphNode>& nodes,
                              const std::vector<GraphEdge>& edges, const std::vector<Area>& areas) {
  for (auto& x : nodes) {
    nodes_.insert_or_assign(x.id, x);
    next_node_ = std::max(next_node_, x.id + 1);
  }
  for (auto& x : areas) {
    areas_.insert_or_assign(x.id, x);
    next_area_ = std::max(next_area_, x.id + 1);
  }
  for (auto& x : edges) {
    const auto key = edge_key(x.a, x.b);
    auto a = nodes_.find(x.a);
    auto b = nodes_.find(x.b);
    if (a == nodes_.end() || b == nodes_.end()) {
      changes_.edges.insert(key);
      continue;
    }
    edges_.insert_or_assign(key, x);
    const auto length = distance(a->second.pose, b->second.pose);
    factors_[key] = length > 0 ? std::max(1.0, x.cost / length) : 1;
    neighbours_[x.a].insert(x.b);
    neighbours_[x.b].insert(x.a);
  }
  is_connected_anew_ = true;
}

const std::set<std::int64_t>& NavigationGraph::neighbours(std::int64_t node) const {
  static const std::set<std::int64_t> none;
  auto x = neighbours_.find(node);
  return x == neighbours_.end() ? none : x->second;
}

std::int64_t NavigationGraph::add(NodeKind kind, const Pose2& pose, std::int64_t keyframe,
                                  const Pose2& robot, double width) {
  GraphNode x;
  x.id = next_node_++;
  x.kind = kind;
  x.pose = pose;
  x.width = width;
  x.keyframe = keyframe;
  x.on_keyframe = between(robot, pose);
  nodes_.emplace(x.id, x);
  changes_.nodes.insert(x.id);
  is_connected_anew_ = true;
  return x.id;
}

void NavigationGraph::remove(std::int64_t node) {
  for (auto other : std::set<std::int64_t>{neighbours(node)})
    disconnect(node, other);
  neighbours_.erase(node);
  nodes_.erase(node);
  changes_.nodes.insert(node);
  is_connected_anew_ = true;
}

void NavigationGraph::make_place(std::int64_t gateway) {
  auto& x = nodes_.at(gateway);
  x.kind = NodeKind::place;
  x.width = 0;
  changes_.nodes.insert(gateway);
  is_connected_anew_ = true;
}

void NavigationGraph::merge(std::int64_t node, std::int64_t into) {
  for (auto other : std::set<std::int64_t>{neighbours(node)}) {
    const auto share = factors_.at(edge_key(node, other));
    disconnect(node, other);
    if (other == into || neighbours(into).contains(other))
      continue;
    connect(other, into, options_.comfort);
    factors_[edge_key(other, into)] = share;
    update_cost(edge_key(other, into));
  }
  remove(node);
}

void NavigationGraph::move(std::int64_t node, const Pose2& pose) {
  auto& x = nodes_.at(node);
  if (distance(x.pose, pose) < options_.tolerance &&
      std::abs(normalised(x.pose.heading - pose.heading)) < options_.heading_tolerance)
    return;
  x.pose = pose;
  changes_.nodes.insert(node);
  has_moved_ = true;
  for (auto other : neighbours(node))
    update_cost(edge_key(node, other));
}

void NavigationGraph::anchor(std::int64_t node, std::int64_t keyframe, const Pose2& robot) {
  auto& x = nodes_.at(node);
  x.keyframe = keyframe;
  x.on_keyframe = between(robot, x.pose);
  changes_.nodes.insert(node);
}

void NavigationGraph::set_width(std::int64_t node, double width) {
  auto& x = nodes_.at(node);
  if (std::abs(x.width - width) < options_.tolerance)
    return;
  x.width = width;
  changes_.nodes.insert(node);
}

double NavigationGraph::factor(double clearance) const {
  return 1 + options_.narrowness * std::clamp(1 - clearance / options_.comfort, 0.0, 1.0);
}

void NavigationGraph::connect(std::int64_t a, std::int64_t b, double clearance) {
  const auto key = edge_key(a, b);
  if (a == b || edges_.contains(key))
    return;
  edges_[key] = {key.first, key.second, 0};
  factors_[key] = factor(clearance);
  neighbours_[a].insert(b);
  neighbours_[b].insert(a);
  changes_.edges.insert(key);
  is_connected_anew_ = true;
  edges_[key].cost = factors_[key] * distance(nodes_.at(a).pose, nodes_.at(b).pose);
}

void NavigationGraph::disconnect(std::int64_t a, std::int64_t b) {
  const auto key = edge_key(a, b);
  if (edges_.erase(key) == 0)
    return;
  factors_.erase(key);
  neighbours_[a].erase(b);
  neighbours_[b].erase(a);
  changes_.edges.insert(key);
  is_connected_anew_ = true;
}

void NavigationGraph::update_cost(const EdgeKey& edge) {
  const auto cost =
    factors_.at(edge) * distance(nodes_.at(edge.first).pose, nodes_.at(edge.second).pose);
  auto& x = edges_.at(edge);
  if (std::abs(x.cost - cost) < options_.tolerance)
    return;
  x.cost = cost;
  changes_.edges.insert(edge);
}

void NavigationGraph::label(std::int64_t area, const std::string& label) {
  if (auto x = areas_.find(area); x != areas_.end())
    x->second.label = label;
}

} // namespace castor::mapping
