#pragma once

#include "castor/perception/vision/tabletop/tabletop_renderer_body.hpp"
#include "castor/perception/vision/tabletop/tabletop_scene.hpp"
#include "castor/perception/vision/types.hpp"

/// Where an object need not be looked for: outside of these bounds, which may be too wide but are
/// never too narrow.
namespace castor::vision {

/// The pixels that an object may be seen in.
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

  bool holds(const Point3& point) const {
    return point.x >= left && point.x <= right && point.y >= near && point.y <= far;
  }
};

PixelWindow window_of(const Body& body, const Camera& camera);

/// Where the object may cast a shadow.
TablePatch shadow_patch(const TabletopObject& object, const Point3& lamp, double lamp_radius);

} // namespace castor::vision
