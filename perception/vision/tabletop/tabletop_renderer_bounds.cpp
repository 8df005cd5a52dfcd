#include "castor/perception/vision/tabletop/tabletop_renderer_bounds.hpp"

#include <algorithm>
#include <limits>

#include "castor/mapping/geometry/camera_model.hpp"
#include "castor/mapping/geometry/eigen_bridge.hpp"

namespace castor::vision {

using namespace geometry;

using Eigen::AlignedBox3d;
using Eigen::Vector3d;

namespace {

AlignedBox3d box_around(const Vector3d& centre, const Vector3d& half_size) {
  return {centre - half_size, centre + half_size};
}

/// One of the corners of a box, which are numbered from 0 to 7.
Vector3d corner(const AlignedBox3d& box, int number) {
  return box.corner(static_cast<AlignedBox3d::CornerType>(number));
}

} // namespace

PixelWindow window_of(const Body& body, const Camera& camera) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  constexpr PixelWindow everything{-infinity, -infinity, infinity, infinity};
  // The image of a box is the hull of its corners' images only where straight lines stay straight.
  if (camera.k1 != 0 || camera.k2 != 0 || camera.k3 != 0 || camera.t1 != 0 || camera.t2 != 0)
    return everything;
  PixelWindow window{infinity, infinity, -infinity, -infinity};
  const auto box = box_around(body.centre(), Vector3d::Constant(body.radius()));
  for (int i = 0; i < 8; ++i) {
    const auto pixel = project(camera, to_point(corner(box, i)));
    if (!pixel)
      return everything;
    window.left = std::min(window.left, pixel->x);
    window.top = std::min(window.top, pixel->y);
    window.right = std::max(window.right, pixel->x);
    window.bottom = std::max(window.bottom, pixel->y);
  }
  return window;
}

namespace {

TablePatch shadow_of(const AlignedBox3d& object_box, const Vector3d& lamp, double lamp_radius) {
  const auto lamp_box = box_around(lamp, Vector3d::Constant(lamp_radius));
  constexpr double infinity = std::numeric_limits<double>::infinity();
  TablePatch patch{infinity, -infinity, infinity, -infinity};
  // The shadow of a box, from any point of a box about the lamp, is spanned by the corners'
  // shadows.
  for (int i = 0; i < 64; ++i) {
    const Vector3d from = corner(lamp_box, i % 8);
    const Vector3d over = corner(object_box, i / 8);
    if (!(from.z() > over.z()))
      return {-infinity, infinity, -infinity, infinity};
    const Vector3d shadow = over + over.z() / (from.z() - over.z()) * (over - from);
    patch = {std::min(patch.left, shadow.x()), std::max(patch.right, shadow.x()),
             std::min(patch.near, shadow.y()), std::max(patch.far, shadow.y())};
  }
  return patch;
}

} // namespace

TablePatch shadow_patch(const TabletopObject& object, const Vector3d& lamp, double lamp_radius) {
  const auto bounds = bounding_box(object);
  return shadow_of(box_around(to_eigen(bounds.centroid), to_eigen(bounds.size) / 2), lamp,
                   lamp_radius);
}

TablePatch shadow_patch(const Body& body, const Vector3d& lamp, double lamp_radius) {
  return shadow_of(box_around(body.centre(), Vector3d::Constant(body.radius())), lamp, lamp_radius);
}

} // namespace castor::vision
