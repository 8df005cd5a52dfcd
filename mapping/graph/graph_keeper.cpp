#include "castor/mapping/graph/graph_keeper.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>

namespace castor::mapping {

namespace {

/// How far the wall beside a door is taken to go on: the robot's path between two nodes may be
/// round a corner that their straight line cuts. Metres.
constexpr double wall_beside = 0.4;
/// The robot passes a door within this distance beside its posts, as they are known; metres.
constexpr double post_error = 0.15;
/// A robot that is so far from its last keyframe came there unseen, metres.
constexpr double longest_step = 1;
/// Node that was a gateway before a restart and the gateway that is found again, metres.
constexpr double same_door = 0.6;

Point2 point_of(const Pose2& x) {
  return {x.x, x.y};
}

/// The opening and the wall beside it.
Line2 line_of(const Pose2& pose, double width, double beside) {
  const auto half = width / 2 + beside;
  return {transform(pose, {0, -half}), transform(pose, {0, half})};
}

/// In the middle of an opening, facing one of its sides.
Pose2 pose_across(const Line2& x) {
  const auto along = std::atan2(x.b.y - x.a.y, x.b.x - x.a.x);
  return {(x.a.x + x.b.x) / 2, (x.a.y + x.b.y) / 2, normalised(along + std::numbers::pi / 2)};
}

/// Positive in front of the gateway, negative behind.
double side_of(const Pose2& gateway, const Point2& p) {
  return transform(inverse(gateway), p).x;
}

} // namespace

GraphKeeper::GraphKeeper(const GraphOptions& options)
  : options_(options), graph_(options.graph), tracker_(options.gateways), moving_(options.moving) {}

void GraphKeeper::restore(const std::vector<GraphNode>& nodes, const std::vector<GraphEdge>& edges,
                          const std::vector<Area>& areas, const RobotArea& position) {
  graph_.restore(nodes, edges, areas);
  position_ = position;
  if (!graph_.nodes().contains(position_.node))
    position_.node = -1;
}

void GraphKeeper::add(std::int64_t keyframe, const ScanPtr& scan, const Pose2& local_pose,
                      const Pose2& robot) {
  const auto before = poses_.empty() ? robot : std::prev(poses_.end())->second;
  poses_[keyframe] = robot;
  const auto ignored = moving_.add(scan, local_pose);
  clearance_.add(keyframe, robot, *scan, ignored);
  tracker_.add(keyframe, robot, *scan, find_openings(*scan, ignored, options_.doors));
  if (keyframe <= position_.keyframe)
    return;
  update_gateways();
  go(before, robot, keyframe);
  connect_gateways(robot);
  position_.keyframe = keyframe;
}

void GraphKeeper::correct(std::int64_t keyframe, const Pose2& robot) {
  auto x = poses_.find(keyframe);
  if (x == poses_.end() || x->second == robot)
    return;
  x->second = robot;
  clearance_.move(keyframe, robot);
  is_corrected_ = true;
}

void GraphKeeper::remove(std::int64_t keyframe) {
  if (poses_.erase(keyframe) == 0)
    return;
  clearance_.remove(keyframe);
  tracker_.remove(keyframe, [this](std::int64_t x) { return poses_.at(x); });
  if (poses_.empty())
    return;
  std::vector<std::int64_t> anchored;
  for (auto& [id, node] : graph_.nodes())
    if (node.keyframe == keyframe)
      anchored.push_back(id);
  for (auto id : anchored) {
    const auto other = nearest_keyframe(graph_.nodes().at(id).pose);
    graph_.anchor(id, other, poses_.at(other));
  }
}

std::int64_t GraphKeeper::nearest_keyframe(const Pose2& pose) const {
  return std::ranges::min_element(poses_, {}, [&](auto& x) { return distance(x.second, pose); })
    ->first;
}

void GraphKeeper::finish() {
  if (std::exchange(is_corrected_, false)) {
    tracker_.correct([this](std::int64_t x) { return poses_.at(x); });
    move_nodes();
  }
  update_gateways();
  graph_.update_areas();
  if (auto x = graph_.nodes().find(position_.node);
      x != graph_.nodes().end() && x->second.area >= 0)
    position_.area = x->second.area;
  else if (auto area = graph_.areas().find(position_.area);
           area != graph_.areas().end() && area->second.merged_into >= 0)
    position_.area = area->second.merged_into;
}

void GraphKeeper::reconcile(const RoomSegments& rooms) {
  // A little beyond the wall, on both sides of it.
  constexpr double beyond = 0.5; // m
  for (auto& [id, x] : tracker_.gateways()) {
    const auto front = rooms.at(transform(x.pose, {beyond, 0}));
    const auto back = rooms.at(transform(x.pose, {-beyond, 0}));
    const bool is_at_opening = std::ranges::any_of(rooms.openings, [&](const Line2& opening) {
      return tracker_.is_same(pose_across(opening), x.pose);
    });
    std::optional<bool> support;
    if (front >= 0 && back >= 0 && (front == back || is_at_opening))
      support = front != back;
    tracker_.support(id, support);
  }
}

void GraphKeeper::move_nodes() {
  std::vector<std::pair<std::int64_t, Pose2>> moved;
  for (auto& [id, node] : graph_.nodes())
    if (auto anchor = poses_.find(node.keyframe); anchor != poses_.end())
      moved.emplace_back(id, compose(anchor->second, node.on_keyframe));
  for (auto& [id, pose] : moved)
    graph_.move(id, pose);
}

void GraphKeeper::update_gateways() {
  std::vector<std::int64_t> gone;
  for (auto& [id, door] : doors_) {
    auto x = tracker_.gateways().find(id);
    if (x == tracker_.gateways().end() || !counts(x->second))
      gone.push_back(id);
  }
  for (auto& [id, x] : tracker_.gateways())
    if (counts(x))
      add_gateway(x);
  for (auto id : gone)
    drop_gateway(id);
}

bool GraphKeeper::counts(const Gateway& gateway) const {
  return gateway.is_confirmed && (!gateway.is_doubted || is_passed(gateway));
}

bool GraphKeeper::is_passed(const Gateway& gateway) const {
  if (auto door = doors_.find(gateway.id); door != doors_.end())
    return has_neighbour_on_side(door->second, transform(door->second.pose, {1, 0})) &&
           has_neighbour_on_side(door->second, transform(door->second.pose, {-1, 0}));
  return std::ranges::any_of(graph_.edges(), [&](auto& x) {
    const Line2 way{point_of(graph_.nodes().at(x.first.first).pose),
                    point_of(graph_.nodes().at(x.first.second).pose)};
    return cross(gateway.line(), way);
  });
}

void GraphKeeper::add_gateway(const Gateway& gateway) {
  auto [door, is_new] = doors_.try_emplace(gateway.id);
  auto& x = door->second;
  const bool has_moved =
    is_new || distance(x.pose, gateway.pose) > options_.graph.tolerance ||
    std::abs(x.width - gateway.width) > options_.graph.tolerance ||
    std::abs(normalised(x.pose.heading - gateway.pose.heading)) > options_.graph.heading_tolerance;
  if (!has_moved)
    return;
  x.pose = gateway.pose;
  x.width = gateway.width;
  if (is_new) {
    // One of before a restart.
    for (auto& [id, node] : graph_.nodes()) {
      auto is_taken = [&, node_id = id](auto& other) { return other.second.node == node_id; };
      if (node.kind == NodeKind::gateway && distance(node.pose, gateway.pose) < same_door &&
          std::ranges::none_of(doors_, is_taken)) {
        x.node = id;
        break;
      }
    }
  }
  if (x.node < 0) {
    x.node = graph_.add(NodeKind::gateway, gateway.pose, gateway.keyframe,
                        poses_.at(gateway.keyframe), gateway.width);
    split_edges(x);
    return;
  }
  const auto& node = graph_.nodes().at(x.node);
  const bool differs = distance(node.pose, gateway.pose) > options_.graph.tolerance;
  graph_.set_width(x.node, gateway.width);
  graph_.move(x.node, gateway.pose);
  if (differs)
    graph_.anchor(x.node, gateway.keyframe, poses_.at(gateway.keyframe));
}

void GraphKeeper::drop_gateway(std::int64_t gateway) {
  const auto door = doors_.at(gateway);
  doors_.erase(gateway);
  // It may be one with another one now.
  for (auto& [id, other] : doors_) {
    if (distance(other.pose, door.pose) > options_.gateways.near)
      continue;
    graph_.merge(door.node, other.node);
    if (position_.node == door.node)
      position_.node = other.node;
    return;
  }
  const auto& neighbours = graph_.neighbours(door.node);
  bool has_front = false;
  bool has_back = false;
  for (auto x : neighbours)
    (side_of(door.pose, point_of(graph_.nodes().at(x).pose)) > 0 ? has_front : has_back) = true;
  if (has_front && has_back) {
    graph_.make_place(door.node);
    return;
  }
  if (position_.node == door.node)
    position_.node = neighbours.empty() ? -1 : *neighbours.begin();
  graph_.remove(door.node);
}

void GraphKeeper::split_edges(const Door& door) {
  const auto wall = line_of(door.pose, door.width, wall_beside);
  std::vector<EdgeKey> through;
  for (auto& [key, edge] : graph_.edges()) {
    const auto& a = graph_.nodes().at(key.first);
    const auto& b = graph_.nodes().at(key.second);
    if (key.first != door.node && key.second != door.node && a.kind == NodeKind::place &&
        b.kind == NodeKind::place && cross(wall, {point_of(a.pose), point_of(b.pose)}))
      through.push_back(key);
  }
  for (auto& [a, b] : through) {
    graph_.disconnect(a, b);
    connect_way(a, door.node);
    connect_way(door.node, b);
  }
}

void GraphKeeper::connect_way(std::int64_t a, std::int64_t b) {
  const Line2 line{point_of(graph_.nodes().at(a).pose), point_of(graph_.nodes().at(b).pose)};
  for (auto& entry : doors_) {
    const auto& door = entry.second;
    if (door.node == a || door.node == b || door.node < 0 ||
        !cross(line_of(door.pose, door.width, wall_beside), line))
      continue;
    connect_driven(a, door.node);
    connect_driven(door.node, b);
    return;
  }
  connect_driven(a, b);
}

void GraphKeeper::connect_driven(std::int64_t a, std::int64_t b) {
  const auto& from = graph_.nodes().at(a);
  const auto& to = graph_.nodes().at(b);
  graph_.connect(
    a, b, clearance_.clearance({point_of(from.pose), point_of(to.pose)}, options_.graph.comfort));
  if (from.kind == NodeKind::gateway && to.kind == NodeKind::place)
    drop_detours(a, b);
  else if (from.kind == NodeKind::place && to.kind == NodeKind::gateway)
    drop_detours(b, a);
}

/// Longer ways from a gateway to places near the one that the robot has driven to, as from where
/// the gateway was only seen.
void GraphKeeper::drop_detours(std::int64_t gateway, std::int64_t place) {
  const auto door = graph_.nodes().at(gateway).pose;
  const auto at = graph_.nodes().at(place).pose;
  const auto& beside = graph_.neighbours(place);
  const auto is_near = [&](std::int64_t x) {
    return beside.contains(x) || std::ranges::any_of(graph_.neighbours(x), [&](std::int64_t y) {
             return y != gateway && beside.contains(y);
           });
  };
  for (auto x : std::set<std::int64_t>{graph_.neighbours(gateway)}) {
    const auto there = graph_.nodes().at(x).pose;
    if (x != place && distance(there, door) > distance(at, door) &&
        side_of(door, point_of(there)) * side_of(door, point_of(at)) > 0 && is_near(x))
      graph_.disconnect(x, gateway);
  }
}

bool GraphKeeper::goes_through_wall(const Line2& line, std::int64_t except) const {
  return std::ranges::any_of(doors_, [&](auto& x) {
    return x.second.node != except &&
           cross(line_of(x.second.pose, x.second.width, wall_beside), line);
  });
}

bool GraphKeeper::is_free(const Point2& a, const Point2& b) const {
  return clearance_.clearance({a, b}, options_.free_way) >= options_.free_way;
}

std::optional<std::int64_t> GraphKeeper::nearest_place(const Pose2& robot, double within) const {
  std::vector<std::pair<double, std::int64_t>> near;
  for (auto& [id, node] : graph_.nodes())
    if (auto far = distance(node.pose, robot); node.kind == NodeKind::place && far < within)
      near.emplace_back(far, id);
  std::ranges::sort(near);
  for (auto& [far, id] : near) {
    const auto place = point_of(graph_.nodes().at(id).pose);
    if (!goes_through_wall({point_of(robot), place}, -1) &&
        (id == position_.node || is_free(point_of(robot), place)))
      return id;
  }
  return std::nullopt;
}

void GraphKeeper::arrive(std::int64_t node) {
  if (position_.node >= 0 && position_.node != node)
    connect_way(position_.node, node);
  position_.node = node;
}

void GraphKeeper::go(const Pose2& from, const Pose2& to, std::int64_t keyframe) {
  if (distance(from, to) > longest_step && !is_free(point_of(from), point_of(to)))
    position_.node = -1;
  bool is_near_gateway = false;
  for (auto& [id, door] : doors_) {
    if (cross(line_of(door.pose, door.width, post_error), {point_of(from), point_of(to)}))
      arrive(door.node);
    is_near_gateway = is_near_gateway || distance(door.pose, to) < options_.spacing / 2;
  }
  if (auto place = nearest_place(to, options_.spacing)) {
    // A little nearer, so that the place does not change to and fro between two.
    constexpr double at_place = 0.6;
    if (distance(graph_.nodes().at(*place).pose, to) < at_place * options_.spacing)
      arrive(*place);
    return;
  }
  if (!is_near_gateway)
    arrive(graph_.add(NodeKind::place, to, keyframe, to));
}

bool GraphKeeper::has_neighbour_on_side(const Door& door, const Point2& of) const {
  return std::ranges::any_of(graph_.neighbours(door.node), [&](std::int64_t x) {
    return side_of(door.pose, point_of(graph_.nodes().at(x).pose)) * side_of(door.pose, of) > 0;
  });
}

void GraphKeeper::connect_gateways(const Pose2& robot) {
  const auto place = position_.node;
  if (place < 0 || graph_.nodes().at(place).kind == NodeKind::gateway)
    return;
  const auto from = point_of(graph_.nodes().at(place).pose);
  for (auto& [id, door] : doors_) {
    const auto to = point_of(door.pose);
    if (distance(to, from) > options_.gateway_reach ||
        distance(to, point_of(robot)) > options_.gateway_reach ||
        has_neighbour_on_side(door, from) || goes_through_wall({from, to}, door.node) ||
        !is_free(from, to))
      continue;
    graph_.connect(place, door.node, clearance_.clearance({from, to}, options_.graph.comfort));
  }
}

} // namespace castor::mapping
