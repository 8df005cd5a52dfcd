#include "castor/perception/vision/tabletop/tabletop_renderer_bounds.hpp"

#include <algorithm>
#include <limits>

#include "castor/perception/vision/camera/camera_model.hpp"
#include "castor/perception/vision/camera/camera_model_vectors.hpp"

namespace castor::vision {

using namespace vectors;

PixelWindow window_of(const Body& body, const Camera& camera) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  constexpr PixelWindow everything{-infinity, -infinity, infinity, infinity};
  // The image of a box is the hull of its corners' images only where straight lines stay straight.
  if (camera.k1 != 0 || camera.k2 != 0 || camera.k3 != 0 || camera.t1 != 0 || camera.t2 != 0)
    return everything;
  PixelWindow window{infinity, infinity, -infinity, -infinity};
  for (int corner = 0; corner < 8; ++corner) {
    const Point3 direction{corner & 1 ? 1.0 : -1.0, corner & 2 ? 1.0 : -1.0,
                           corner & 4 ? 1.0 : -1.0};
    const auto pixel = project(camera, body.centre() + body.radius() * direction);
    if (!pixel)
      return everything;
    window.left = std::min(window.left, pixel->x);
    window.top = std::min(window.top, pixel->y);
    window.right = std::max(window.right, pixel->x);
    window.bottom = std::max(window.bottom, pixel->y);
  }
  return window;
}

TablePatch shadow_patch(const TabletopObject& object, const Point3& lamp, double lamp_radius) {
  const auto box = bounding_box(object);
  const auto corner = [](const Point3& middle, const Point3& half, int bits) {
    return Point3{middle.x + (bits & 1 ? half.x : -half.x),
                  middle.y + (bits & 2 ? half.y : -half.y),
                  middle.z + (bits & 4 ? half.z : -half.z)};
  };
  constexpr double infinity = std::numeric_limits<double>::infinity();
  TablePatch patch{infinity, -infinity, infinity, -infinity};
  // The shadow of a box, from any point of a box about the lamp, is spanned by the corners'
  // shadows.
  for (int i = 0; i < 64; ++i) {
    const Point3 from = corner(lamp, {lamp_radius, lamp_radius, lamp_radius}, i % 8);
    const Point3 over = corner(box.centroid, 0.5 * box.size, i / 8);
    if (!(from.z > over.z))
      return {-infinity, infinity, -infinity, infinity};
    const Point3 shadow = over + over.z / (from.z - over.z) * (over - from);
    patch = {std::min(patch.left, shadow.x), std::max(patch.right, shadow.x),
             std::min(patch.near, shadow.y), std::max(patch.far, shadow.y)};
  }
  return patch;
}

} // namespace castor::vision
