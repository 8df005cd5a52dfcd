#include "castor/planning/manipulation/table_world.hpp"

#include "castor/mapping/geometry/poses.hpp"
#include "castor/planning/manipulation/collision_checker.hpp"
#include "castor/planning/manipulation/grasp_candidates.hpp"
#include "castor/planning/manipulation/kinematic_chain.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace castor::manipulation {

namespace {

using Eigen::Vector3d;

constexpr const char* the_floor = "the floor";
constexpr const char* the_gripper = "the gripper";
// Things that rest on each other do not touch by rounding errors.
constexpr double apart = 1e-6;
// What is in the way is left behind in steps of this length, metres; as many lead over the edge of
// any table of 10 m.
constexpr double slide = 0.005;
constexpr int most_slides = 2000;
// Height of a table, metres.
constexpr double floor_below = 0.75;

double height_of_middle(const NamedSolid& x) {
  return half_height(x.solid, x.pose.rotation);
}

double top_of(const NamedSolid& x) {
  return x.pose.position.z + height_of_middle(x);
}

/// The direction of a thing that is up once it has turned onto its nearest side, in its own axes.
Vector3d nearest_side(const NamedSolid& x) {
  const Vector3d up = geometry::to_eigen(x.pose.rotation).inverse() * Vector3d::UnitZ();
  Eigen::Index axis = 0;
  up.cwiseAbs().maxCoeff(&axis);
  if (x.solid.kind != SolidKind::box && axis != 2)
    // Round ones lie on whatever side they have come to.
    return Vector3d(up.x(), up.y(), 0).normalized();
  return std::copysign(1.0, up[axis]) * Vector3d::Unit(axis);
}

/// Turns a thing onto its nearest side; a capsule cannot stand.
geometry::Rotation resting(const NamedSolid& x) {
  if (x.solid.kind == SolidKind::sphere)
    return x.pose.rotation;
  const auto rotation = geometry::to_eigen(x.pose.rotation).normalized();
  Vector3d side = nearest_side(x);
  if (x.solid.kind == SolidKind::capsule && std::abs(side.z()) > 0.5)
    side = Vector3d::UnitX();
  return geometry::to_rotation(
    Eigen::Quaterniond::FromTwoVectors(rotation * side, Vector3d::UnitZ()) * rotation);
}

/// Whether the top is flat.
bool has_flat_top(const NamedSolid& x) {
  const Vector3d up = geometry::to_eigen(x.pose.rotation).inverse() * Vector3d::UnitZ();
  return x.solid.kind == SolidKind::box ||
         (x.solid.kind == SolidKind::cylinder && std::abs(up.z()) > 0.99);
}

/// Whether a vertical line through a point meets a thing that rests.
bool is_below(const NamedSolid& x, const Point3& point) {
  const Vector3d offset(point.x - x.pose.position.x, point.y - x.pose.position.y, 0);
  const Vector3d own = geometry::to_eigen(x.pose.rotation).inverse() * offset;
  const auto& size = x.solid.size;
  if (x.solid.kind == SolidKind::box)
    return std::abs(own.x()) <= size.x / 2 && std::abs(own.y()) <= size.y / 2 &&
           std::abs(own.z()) <= size.z / 2;
  if (x.solid.kind == SolidKind::sphere || has_flat_top(x))
    return offset.norm() <= size.x / 2;
  return std::hypot(own.x(), own.y()) <= size.x / 2 && std::abs(own.z()) <= size.z / 2;
}

/// Horizontal direction from one thing to the other; x, if one is exactly above the other.
Eigen::Vector2d direction_from(const NamedSolid& a, const NamedSolid& b) {
  const Eigen::Vector2d result(b.pose.position.x - a.pose.position.x,
                               b.pose.position.y - a.pose.position.y);
  return result.norm() > apart ? Eigen::Vector2d(result.normalized())
                               : Eigen::Vector2d(Eigen::Vector2d::UnitX());
}

} // namespace

TableWorld::TableWorld(NamedSolid table) : table_(std::move(table)) {
  // nop
}

std::size_t TableWorld::index_of(const std::string& name) const {
  const auto found = std::ranges::find(
    things_, name, [](const auto& x) -> const auto& { return x.thing.name; });
  if (found == things_.end())
    throw std::invalid_argument("there is no " + name + " on " + table_.name);
  return static_cast<std::size_t>(found - things_.begin());
}

const WorldThing& TableWorld::thing(const std::string& name) const {
  return things_[index_of(name)];
}

const WorldThing* TableWorld::held() const {
  const auto found = std::ranges::find(things_, the_gripper, &WorldThing::support);
  return found == things_.end() ? nullptr : &*found;
}

std::vector<std::size_t> TableWorld::stack(std::size_t bottom) const {
  std::vector<std::size_t> result{bottom};
  for (std::size_t i = 0; i < result.size(); ++i)
    for (std::size_t j = 0; j < things_.size(); ++j)
      if (things_[j].support == things_[result[i]].thing.name)
        result.push_back(j);
  return result;
}

void TableWorld::add(const NamedSolid& thing) {
  const bool is_taken =
    thing.name == table_.name ||
    std::ranges::any_of(things_, [&](const auto& x) { return x.thing.name == thing.name; });
  if (is_taken)
    throw std::invalid_argument("there is already " + thing.name +
                                " on the table: give things different names");
  if (!(least_width(thing.solid) > 0))
    throw std::invalid_argument("a length of " + thing.name + " is not more than 0");
  things_.push_back({thing, the_floor});
  settle({things_.size() - 1});
}

void TableWorld::remove(const std::string& name) {
  const auto index = index_of(name);
  auto above = stack(index);
  above.erase(above.begin());
  things_.erase(things_.begin() + static_cast<std::ptrdiff_t>(index));
  for (auto& x : above)
    x -= x > index;
  settle(above);
}

std::optional<std::string> TableWorld::close_gripper(const Gripper& gripper, const Pose& tool,
                                                     double opening) {
  tool_ = tool;
  if (const auto* thing = held())
    return thing->thing.name;
  const auto found = between(gripper, tool, opening);
  if (found == things_.size())
    return {};
  things_[found].support = the_gripper;
  return things_[found].thing.name;
}

/// Index of the thing, or the number of things.
std::size_t TableWorld::between(const Gripper& gripper, const Pose& tool, double opening) const {
  // A thing is grasped if it is in the way of the fingers' middles.
  const NamedSolid gap{"", gap_between_fingers(gripper, opening), tool};
  const auto found = std::ranges::find_if(
    things_, [&](const auto& x) { return x.support != the_floor && overlap(x.thing, gap); });
  return static_cast<std::size_t>(found - things_.begin());
}

const WorldThing* TableWorld::between_fingers(const Gripper& gripper, const Pose& tool,
                                              double opening) const {
  const auto found = between(gripper, tool, opening);
  return found == things_.size() ? nullptr : &things_[found];
}

bool TableWorld::push(const std::string& name, double x, double y) {
  const auto index = index_of(name);
  if (things_[index].support == the_gripper)
    return false;
  const auto pushed = stack(index);
  for (auto i : pushed) {
    auto moved = things_[i];
    moved.thing.pose.position.x += x;
    moved.thing.pose.position.y += y;
    const auto is_in_the_way = [&](std::size_t j) {
      return std::ranges::count(pushed, j) == 0 && things_[j].thing.name != moved.support &&
             overlap(things_[j].thing, moved.thing);
    };
    for (std::size_t j = 0; j < things_.size(); ++j)
      if (is_in_the_way(j))
        return false;
  }
  for (auto i : pushed) {
    things_[i].thing.pose.position.x += x;
    things_[i].thing.pose.position.y += y;
  }
  settle(pushed);
  return true;
}

void TableWorld::move_tool(const Pose& tool) {
  if (const auto* thing = held()) {
    const auto before = geometry::inverse(tool_, "");
    for (auto index : stack(index_of(thing->thing.name))) {
      auto& pose = things_[index].thing.pose;
      pose = geometry::compose(tool, geometry::compose(before, pose));
    }
  }
  tool_ = tool;
}

std::optional<std::string> TableWorld::open_gripper() {
  const auto* thing = held();
  if (!thing)
    return {};
  auto name = thing->thing.name;
  settle(stack(index_of(name)));
  return name;
}

void TableWorld::restore(const std::vector<WorldThing>& things, const Pose& tool) {
  const auto have_one_name = [](const WorldThing& a, const WorldThing& b) {
    return a.thing.name == b.thing.name;
  };
  if (!std::ranges::equal(things_, things, have_one_name))
    throw std::invalid_argument("there are other things on " + table_.name);
  for (std::size_t i = 0; i < things.size(); ++i) {
    things_[i].thing.pose = things[i].thing.pose;
    things_[i].support = things[i].support;
  }
  tool_ = tool;
}

void TableWorld::settle(const std::vector<std::size_t>& from_below) {
  // Nobody rests on what falls itself.
  for (auto index : from_below)
    things_[index].support.clear();
  for (auto index : from_below)
    fall(things_[index]);
}

void TableWorld::fall(WorldThing& falling) const {
  auto& pose = falling.thing.pose;
  pose.rotation = resting(falling.thing);
  const double half = height_of_middle(falling.thing);
  Eigen::Vector2d direction = Eigen::Vector2d::Zero();
  for (int i = 0; i < most_slides; ++i) {
    const auto* below = support_below(falling);
    const bool is_on_table = !below && is_below(table_, pose.position);
    pose.position.z = half + apart +
                      (below         ? top_of(below->thing)
                       : is_on_table ? top_of(table_)
                                     : top_of(table_) - floor_below);
    falling.support = below ? below->thing.name : is_on_table ? table_.name : the_floor;
    if (falling.support == the_floor)
      return;
    const auto* obstacle = below && !has_flat_top(below->thing) ? below : obstacle_at(falling);
    if (!obstacle)
      return;
    // Away from the first obstacle, and on in that direction: others would push it back.
    if (direction == Eigen::Vector2d::Zero())
      direction = direction_from(obstacle->thing, falling.thing);
    pose.position.x += slide * direction.x();
    pose.position.y += slide * direction.y();
  }
}

const WorldThing* TableWorld::support_below(const WorldThing& falling) const {
  const WorldThing* result = nullptr;
  for (const auto& x : things_) {
    const bool rests = !x.support.empty() && x.support != the_floor && x.support != the_gripper;
    if (rests && x.thing.name != falling.thing.name &&
        is_below(x.thing, falling.thing.pose.position) &&
        (!result || top_of(x.thing) > top_of(result->thing)))
      result = &x;
  }
  return result;
}

const WorldThing* TableWorld::obstacle_at(const WorldThing& falling) const {
  for (const auto& x : things_) {
    const bool rests = !x.support.empty() && x.support != the_floor && x.support != the_gripper;
    if (rests && x.thing.name != falling.thing.name && overlap(x.thing, falling.thing))
      return &x;
  }
  return nullptr;
}

Scene TableWorld::scene() const {
  Scene result{{table_}, {}};
  std::vector<std::size_t> carried;
  if (const auto* thing = held()) {
    carried = stack(index_of(thing->thing.name));
    result.held = thing->thing;
    result.held->pose = geometry::compose(geometry::inverse(tool_, "tool"), thing->thing.pose);
  }
  for (std::size_t i = 0; i < things_.size(); ++i)
    if (things_[i].support != the_floor && std::ranges::count(carried, i) == 0)
      result.things.push_back(things_[i].thing);
  return result;
}

} // namespace castor::manipulation
