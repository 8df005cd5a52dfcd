#pragma once

#include "castor/perception/vision/tabletop/tabletop_renderer_body.hpp"
#include "castor/perception/vision/tabletop/tabletop_scene.hpp"
#include "castor/perception/vision/types.hpp"

/// Conservative bounds of an object and its shadow: they may be too wide but are never too narrow.
namespace castor::vision {

/// Pixels in which an object may be visible.
struct PixelWindow {
  double left = 0;
  double top = 0;
  double right = 0;
  double bottom = 0;

  bool holds(const Point2& pixel) const {
    return pixel.x >= left && pixel.x <= right && pixel.y >= top && pixel.y <= bottom;
  }
};

/// A part of the table's surface.
struct TablePatch {
  double left = 0;
  double right = 0;
  double near = 0;
  double far = 0;

  bool holds(const Eigen::Vector3d& point) const {
    return point.x() >= left && point.x() <= right && point.y() >= near && point.y() <= far;
  }
};

PixelWindow window_of(const Body& body, const Camera& camera);

/// Part of the table on which the object may cast a shadow.
TablePatch shadow_patch(const TabletopObject& object, const Eigen::Vector3d& lamp,
                        double lamp_radius);

/// The same for a body anywhere, by the sphere around it.
TablePatch shadow_patch(const Body& body, const Eigen::Vector3d& lamp, double lamp_radius);

} // namespace castor::vision
