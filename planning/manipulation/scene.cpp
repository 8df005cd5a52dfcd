#include "castor/planning/manipulation/scene.hpp"

#include "castor/planning/manipulation/arm_model.hpp"

#include <algorithm>

namespace castor::manipulation {

NamedSolid table_top(double length, double width) {
  constexpr double thickness = 0.04;
  return {"the table", box(length, width, thickness), {{0, 0, -thickness / 2}, {}, arm_frame}};
}

Scene without(Scene scene, const std::vector<std::string>& names) {
  std::erase_if(scene.things, [&](const auto& x) { return std::ranges::count(names, x.name) > 0; });
  return scene;
}

} // namespace castor::manipulation
