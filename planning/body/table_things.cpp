#include "castor/planning/body/table_things.hpp"

#include "castor/mapping/geometry/poses.hpp"
#include "castor/perception/vision/tabletop/tabletop_scene_check.hpp"
#include "castor/planning/manipulation/kinematics.hpp"

#include <algorithm>
#include <utility>

namespace castor::manipulation {

namespace {

using vision::SceneColour;
using vision::TabletopObject;
using vision::TabletopShape;

constexpr double table_thickness = 0.03; // metres
constexpr SceneColour link_colour{70, 72, 78};
constexpr SceneColour finger_colour{40, 40, 44};

Solid solid_of(const TabletopObject& x) {
  switch (x.shape) {
    case TabletopShape::sphere:
      return sphere(x.size.x);
    case TabletopShape::cylinder:
    case TabletopShape::disc:
    case TabletopShape::triangle:
      return cylinder(x.size.x, x.size.z);
    default:
      return box(x.size.x, x.size.y, x.size.z);
  }
}

ViewedShape shape_of(TabletopShape x) {
  switch (x) {
    case TabletopShape::sphere:
      return ViewedShape::sphere;
    case TabletopShape::cylinder:
    case TabletopShape::disc:
      return ViewedShape::cylinder;
    case TabletopShape::triangle:
      return ViewedShape::triangle;
    default:
      return ViewedShape::box;
  }
}

TabletopShape shape_of(ViewedShape x) {
  switch (x) {
    case ViewedShape::sphere:
      return TabletopShape::sphere;
    case ViewedShape::cylinder:
      return TabletopShape::cylinder;
    case ViewedShape::triangle:
      return TabletopShape::triangle;
    case ViewedShape::box:
      break;
  }
  return TabletopShape::box;
}

ViewedBody viewed(ViewedShape shape, const Point3& size, const Pose& pose, SceneColour colour) {
  return {shape, size, pose, colour.red, colour.green, colour.blue};
}

/// A solid as bodies; a capsule is a cylinder and two balls.
void add(std::vector<ViewedBody>& result, const Solid& solid, const Pose& pose,
         SceneColour colour) {
  const auto& size = solid.size;
  switch (solid.kind) {
    case SolidKind::box:
      result.push_back(viewed(ViewedShape::box, size, pose, colour));
      return;
    case SolidKind::cylinder:
      result.push_back(viewed(ViewedShape::cylinder, size, pose, colour));
      return;
    case SolidKind::sphere:
      result.push_back(viewed(ViewedShape::sphere, size, pose, colour));
      return;
    case SolidKind::capsule:
      break;
  }
  const double straight = size.z - size.x;
  if (straight > 0)
    result.push_back(viewed(ViewedShape::cylinder, {size.x, size.x, straight}, pose, colour));
  for (const double end : {-1.0, 1.0}) {
    auto at = pose;
    at.position = geometry::transform(pose, Point3{0, 0, end * std::max(0.0, straight) / 2});
    result.push_back(viewed(ViewedShape::sphere, {size.x, size.x, size.x}, at, colour));
  }
}

} // namespace

TableThings::TableThings(const vision::TabletopSnapshot& scene, const Pose& arm)
  : table_(scene.table), arm_(arm) {
  for (const auto& object : scene.objects) {
    const auto base = vision::description_of(object);
    auto name = base;
    for (int i = 2; looks_.contains(name); ++i)
      name = base + ' ' + std::to_string(i);
    names_.push_back(name);
    looks_[name] = object;
  }
}

TableWorld TableThings::world() const {
  const auto to_arm = geometry::inverse(arm_, arm_frame);
  Pose table;
  table.position.z = -table_thickness / 2;
  table.frame = geometry::table_frame;
  TableWorld result({"the table", box(table_.width, table_.depth, table_thickness),
                     geometry::compose(to_arm, table)});
  for (const auto& name : names_) {
    const auto& object = looks_.at(name);
    result.add({name, solid_of(object), geometry::compose(to_arm, vision::pose_of(object))});
  }
  return result;
}

Pose TableThings::on_table(const Pose& in_arm) const {
  return geometry::compose(arm_, in_arm);
}

std::vector<ViewedBody> TableThings::view(const ArmBody& body) const {
  std::vector<ViewedBody> result;
  for (const auto& [thing, support] : body.world().things()) {
    const auto& look = looks_.at(thing.name);
    result.push_back(viewed(shape_of(look.shape), look.size, on_table(thing.pose), look.colour));
  }
  const auto& arm = body.arm();
  const auto links = link_poses(arm, body.configuration());
  for (std::size_t i = 0; i < links.size(); ++i)
    for (const auto& [solid, pose] : arm.links[i].shapes)
      add(result, solid, on_table(geometry::compose(links[i], pose)), link_colour);
  const auto tool = tool_pose(arm, body.configuration());
  for (const auto& [solid, pose] : fingers(arm, body.opening()))
    add(result, solid, on_table(geometry::compose(tool, pose)), finger_colour);
  return result;
}

vision::TabletopSnapshot snapshot_of(const vision::TabletopSnapshot& setting,
                                     const std::vector<ViewedBody>& bodies) {
  auto result = setting;
  result.objects.clear();
  result.placed.clear();
  for (const auto& x : bodies) {
    TabletopObject object;
    object.shape = shape_of(x.shape);
    object.size = x.size;
    object.colour = {x.red, x.green, x.blue};
    result.placed.push_back({object, x.pose});
  }
  return result;
}

} // namespace castor::manipulation
