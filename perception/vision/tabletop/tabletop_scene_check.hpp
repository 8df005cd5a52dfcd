#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "castor/perception/vision/tabletop/tabletop_scene.hpp"

/// Plausibility check of a scene.
namespace castor::vision {

/// A finding about an object of a scene.
struct SceneRemark {
  /// False for a warning: the scene can be used.
  bool is_error = false;
  /// Object concerned, as an index into TabletopScene::actors.
  std::size_t actor = 0;
  /// Time of its first occurrence.
  SceneTime time{0};
  std::string message;
  std::string remedy;

  friend bool operator==(const SceneRemark&, const SceneRemark&) = default;
};

/// "the red cube", or "mug" if that is its name.
std::string description_of(const TabletopObject& object);

/// Errors: two objects at rest overlap; the middle of an object is beside the table. Warnings: an
/// object passes through another one, sticks out over the table's edge, or is out of the camera's
/// sight when it comes to rest. Each is reported once per object or pair of objects.
std::vector<SceneRemark> check_scene(const TabletopScene& scene);

} // namespace castor::vision
