#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "castor/perception/vision/types.hpp"

/// CLEVR images and their scene graphs: J. Johnson et al., "CLEVR: A diagnostic dataset for
/// compositional language and elementary visual reasoning", 2017.
namespace castor::clevr {

/// An object of a scene graph. Lengths are CLEVR's units, pixels those of the image.
struct Object {
  std::string shape;
  std::string colour;
  std::string material;
  std::string size;
  geometry::Point3 position;
  geometry::Point2 pixel;
  /// Distance along the viewing direction.
  double distance = 0;
  /// Rotation about the vertical axis, radians: CLEVR calls the number degrees, but passed it to
  /// Blender, which takes radians.
  double rotation = 0;

  /// Half the edge of a cube, else the radius; a cylinder's height is twice that.
  double radius() const { return size == "large" ? 0.7 : 0.35; }
};

/// Pairs of indices of objects: the second is on that side of the first.
using ObjectPairs = std::set<std::pair<std::size_t, std::size_t>>;

struct Scene {
  std::filesystem::path image;
  std::vector<Object> objects;
  /// By the word: "left", "right", "front", "behind". Empty if the scene graph has none.
  std::map<std::string, ObjectPairs> relations;
};

/// All scenes below `folder` whose image exists, ordered by image: from files with a list of
/// "scenes", and from files with one scene.
/// \throws std::runtime_error naming the file if a property of an object is missing.
std::vector<Scene> load_scenes(const std::filesystem::path& folder);

} // namespace castor::clevr
