#include "castor/planning/manipulation/collision_checker.hpp"

#include "castor/planning/manipulation/kinematic_chain.hpp"
#include "castor/planning/manipulation/kinematics.hpp"

#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/geometry/shape/box.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/cylinder.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision.h>
#include <fcl/narrowphase/collision_object.h>
#include <fcl/narrowphase/distance.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace castor::manipulation {

namespace {

using Object = fcl::CollisionObjectd;

// Without a margin, as far apart as rounding errors.
constexpr double least_margin = 1e-4;

std::shared_ptr<fcl::CollisionGeometryd> geometry_of(const Solid& solid, double margin) {
  const auto& size = solid.size;
  if (!(size.x > 0 && size.y > 0 && size.z > 0))
    throw std::invalid_argument("a " + to_string(solid.kind) +
                                " has a length that is not more than 0; leave it out of the scene");
  switch (solid.kind) {
    case SolidKind::box:
      return std::make_shared<fcl::Boxd>(size.x + 2 * margin, size.y + 2 * margin,
                                         size.z + 2 * margin);
    case SolidKind::cylinder:
      return std::make_shared<fcl::Cylinderd>(size.x / 2 + margin, size.z + 2 * margin);
    case SolidKind::capsule:
      return std::make_shared<fcl::Capsuled>(size.x / 2 + margin, std::max(0.0, size.z - size.x));
    case SolidKind::sphere:
      break;
  }
  return std::make_shared<fcl::Sphered>(size.x / 2 + margin);
}

/// A solid of the arm, or what it holds.
struct Part {
  std::string name;
  std::size_t link;
  /// How many joints move it.
  std::size_t joints;
  /// It may touch what is grasped.
  bool is_gripper;
  Eigen::Isometry3d on_link;
  Object object;
};

bool touch(Object& a, Object& b) {
  const fcl::CollisionRequestd request;
  fcl::CollisionResultd result;
  return fcl::collide(&a, &b, request, result) > 0;
}

struct ContactSearch {
  /// The part that contacts are looked for of.
  const Object* part = nullptr;
  bool may_touch_some = false;
  const Object* found = nullptr;
};

struct DistanceSearch {
  bool may_touch_some = false;
  double nearest = std::numeric_limits<double>::infinity();
};

/// Things that the gripper may touch have user data.
bool is_exempt(const Object& part, const Object& thing, bool may_touch_some) {
  return may_touch_some && (part.getUserData() || thing.getUserData());
}

bool look_for_contact(Object* a, Object* b, void* data) {
  auto& search = *static_cast<ContactSearch*>(data);
  if (is_exempt(*a, *b, search.may_touch_some) || !touch(*a, *b))
    return false;
  search.found = a == search.part ? b : a;
  return true;
}

bool look_for_nearest(Object* a, Object* b, void* data, double& nearest) {
  auto& search = *static_cast<DistanceSearch*>(data);
  if (!is_exempt(*a, *b, search.may_touch_some)) {
    const fcl::DistanceRequestd request;
    fcl::DistanceResultd result;
    fcl::distance(a, b, request, result);
    // FCL has -1 for those that touch.
    search.nearest = std::min(search.nearest, std::max(0.0, result.min_distance));
  }
  nearest = search.nearest;
  return search.nearest <= 0;
}

} // namespace

bool overlap(const NamedSolid& a, const NamedSolid& b) {
  Object first(geometry_of(a.solid, 0), to_isometry(a.pose));
  Object second(geometry_of(b.solid, 0), to_isometry(b.pose));
  return touch(first, second);
}

struct CollisionChecker::World {
  World(const ArmModel& arm, const Scene& scene, const CollisionOptions& options)
    : chain(arm), margin(std::max(options.margin, least_margin)) {
    add_scene(scene, options);
    add_arm(arm);
    add_gripper(arm, scene, options);
    find_pairs(arm);
    double beyond_tool = 0;
    if (scene.held) {
      const auto& at = scene.held->pose.position;
      beyond_tool = std::hypot(at.x, at.y, at.z) + outer_radius(scene.held->solid);
    }
    const auto levers = lever_arms(arm, beyond_tool);
    const double norm =
      std::sqrt(std::inner_product(levers.begin(), levers.end(), levers.begin(), 0.0));
    step = 2 * margin / norm;
  }

  void add_scene(const Scene& scene, const CollisionOptions& options) {
    for (const auto& thing : scene.things) {
      const auto [solid, pose] = highest(thing);
      things.push_back(
        std::make_unique<Object>(geometry_of(solid, thing.uncertainty), to_isometry(pose)));
      names.push_back(thing.name);
      const bool may_touch = std::ranges::count(options.may_touch, thing.name) > 0;
      things.back()->setUserData(may_touch ? this : nullptr);
      manager.registerObject(things.back().get());
    }
    // Without, the tree is empty.
    manager.setup();
  }

  void add_part(std::string name, std::size_t link, std::size_t joints, bool is_gripper,
                const Solid& solid, const Eigen::Isometry3d& on_link, double uncertainty = 0) {
    parts.push_back({std::move(name), link, joints, is_gripper, on_link,
                     Object(geometry_of(solid, margin + uncertainty))});
    // FCL leaves it undefined.
    parts.back().object.setUserData(nullptr);
  }

  void add_arm(const ArmModel& arm) {
    std::size_t joints = 0;
    for (std::size_t i = 0; i < arm.links.size(); ++i) {
      if (i > 0)
        joints += arm.joints[i - 1].kind != JointKind::fixed;
      for (const auto& shape : arm.links[i].shapes)
        add_part("the " + arm.links[i].name, i, joints, i + 1 == arm.links.size(), shape.solid,
                 to_isometry(shape.pose));
    }
  }

  void add_gripper(const ArmModel& arm, const Scene& scene, const CollisionOptions& options) {
    const auto last = arm.links.size() - 1;
    const double opening = options.opening.value_or(arm.gripper ? arm.gripper->widest : 0);
    for (const auto& finger : fingers(arm, opening))
      add_part("the gripper", last, chain.size(), true, finger.solid,
               chain.tool_on_link() * to_isometry(finger.pose));
    if (scene.held) {
      const auto [solid, pose] = highest(*scene.held);
      add_part(scene.held->name, last, chain.size(), true, solid,
               chain.tool_on_link() * to_isometry(pose), scene.held->uncertainty);
    }
  }

  void find_pairs(const ArmModel& arm) {
    place(arm.home);
    for (std::size_t i = 0; i < parts.size(); ++i)
      for (std::size_t j = i + 1; j < parts.size(); ++j)
        if (parts[j].joints >= parts[i].joints + 2 && !touch(parts[i].object, parts[j].object))
          pairs.emplace_back(i, j);
  }

  void place(std::span<const double> configuration) {
    chain.link_poses(configuration, links);
    for (auto& part : parts) {
      part.object.setTransform(links[part.link] * part.on_link);
      part.object.computeAABB();
    }
  }

  std::string name_of(const Object* thing) const {
    const auto found =
      std::ranges::find(things, thing, [](const auto& x) -> const Object* { return x.get(); });
    return names[static_cast<std::size_t>(found - things.begin())];
  }

  KinematicChain chain;
  double margin;
  double step = 0;
  std::size_t checks = 0;
  std::vector<std::unique_ptr<Object>> things;
  std::vector<std::string> names;
  std::vector<Part> parts;
  /// Parts of the arm that may not touch each other.
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  fcl::DynamicAABBTreeCollisionManagerd manager;
  /// Poses of links, kept to allocate them once.
  std::vector<Eigen::Isometry3d> links;
};

CollisionChecker::CollisionChecker(const ArmModel& arm, const Scene& scene,
                                   const CollisionOptions& options)
  : world_(std::make_unique<World>(arm, scene, options)) {
  // nop
}

CollisionChecker::CollisionChecker(CollisionChecker&&) noexcept = default;
CollisionChecker& CollisionChecker::operator=(CollisionChecker&&) noexcept = default;
CollisionChecker::~CollisionChecker() = default;

std::optional<Contact> CollisionChecker::contact(std::span<const double> configuration) {
  auto& world = *world_;
  ++world.checks;
  world.place(configuration);
  for (auto& part : world.parts) {
    if (part.joints == 0)
      continue;
    ContactSearch search{&part.object, part.is_gripper};
    world.manager.collide(&part.object, &search, look_for_contact);
    if (search.found)
      return Contact{part.name, world.name_of(search.found), false};
  }
  for (const auto& [i, j] : world.pairs)
    if (touch(world.parts[i].object, world.parts[j].object))
      return Contact{world.parts[j].name, world.parts[i].name, true};
  return {};
}

double CollisionChecker::clearance(std::span<const double> configuration) {
  auto& world = *world_;
  world.place(configuration);
  double result = std::numeric_limits<double>::infinity();
  for (auto& part : world.parts) {
    if (part.joints == 0)
      continue;
    DistanceSearch search{part.is_gripper};
    world.manager.distance(&part.object, &search, look_for_nearest);
    result = std::min(result, search.nearest > 0 ? search.nearest + world.margin : 0);
  }
  return result;
}

double CollisionChecker::step() const {
  return world_->step;
}

bool CollisionChecker::is_free_between(std::span<const double> from, std::span<const double> to) {
  const auto steps = std::max(1, static_cast<int>(std::ceil(distance(from, to) / step())));
  Configuration between(from.size());
  for (int i = 0; i <= steps; ++i) {
    const double share = static_cast<double>(i) / steps;
    for (std::size_t j = 0; j < between.size(); ++j)
      between[j] = from[j] + share * (to[j] - from[j]);
    if (!is_free(between))
      return false;
  }
  return true;
}

std::size_t CollisionChecker::checks() const {
  return world_->checks;
}

} // namespace castor::manipulation
