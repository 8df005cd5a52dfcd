#include "castor/planning/manipulation/plan_scene.hpp"

#include "castor/mapping/geometry/poses.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace castor::manipulation {

namespace {

double bottom_of(const NamedSolid& x) {
  return x.pose.position.z - half_height(x.solid, x.pose.rotation);
}

} // namespace

const NamedSolid& named(const Scene& scene, const std::string& name) {
  const auto found = std::ranges::find(scene.things, name, &NamedSolid::name);
  if (found == scene.things.end())
    throw std::invalid_argument("there is no " + name + " in the scene");
  return *found;
}

std::vector<std::string> supports_of(const Scene& scene, const NamedSolid& thing) {
  constexpr double touching = 0.01;
  std::vector<std::string> result;
  for (const auto& x : scene.things)
    if (x.name != thing.name && std::abs(x.pose.position.z + half_height(x.solid, x.pose.rotation) -
                                         bottom_of(thing)) < touching)
      result.push_back(x.name);
  return result;
}

Scene holding(Scene scene, const std::string& thing, const Pose& tool) {
  NamedSolid held = named(scene, thing);
  held.pose = geometry::compose(geometry::inverse(tool, "tool"), held.pose);
  std::erase_if(scene.things, [&](const auto& x) { return x.name == thing; });
  scene.held = std::move(held);
  return scene;
}

Scene released(Scene scene, const Pose& tool) {
  auto thing = *scene.held;
  thing.pose = geometry::compose(tool, thing.pose);
  scene.held.reset();
  scene.things.push_back(std::move(thing));
  return scene;
}

Pose raised(Pose x, double height) {
  x.position.z += height;
  return x;
}

} // namespace castor::manipulation
