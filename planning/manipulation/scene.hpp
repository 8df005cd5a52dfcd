#pragma once

#include "castor/planning/manipulation/solid.hpp"

#include <optional>
#include <string>
#include <vector>

namespace castor::manipulation {

/// What an arm may touch.
struct Scene {
  /// In the arm's frame. The table is one of them.
  std::vector<NamedSolid> things;
  /// What the gripper holds; its pose is in the tool's frame.
  std::optional<NamedSolid> held;

  friend bool operator==(const Scene&, const Scene&) = default;
};

/// The surface that an arm stands on is taken to be so long and so wide, metres.
inline constexpr double table_length = 4;

/// The table as a solid below z = 0 of the arm's frame.
/// @param length,width metres, around the arm
NamedSolid table_top(double length, double width);

/// The scene without the things of these names.
Scene without(Scene scene, const std::vector<std::string>& names);

} // namespace castor::manipulation
