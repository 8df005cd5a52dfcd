#pragma once

#include <array>
#include <optional>
#include <vector>

#include "castor/perception/vision/types.hpp"

/// Outlines of things on the table as a camera sees them, and how well a region's outline agrees.
namespace castor::vision {

/// How far an outline reaches in evenly spread directions, anticlockwise from the right: the
/// largest x cos(a) - y sin(a) of its points; pixels.
using Support = std::array<double, 24>;

Support support_of(const std::vector<Point2>& points);

/// A thing of some shape, projected. Points are pixels.
struct OutlineModel {
  /// Points whose convex hull is the outline.
  std::vector<Point2> points;
  Support support{};
  /// Convex faces in view, the top first.
  std::vector<std::vector<Point2>> faces;
  /// Ends of the upright edge between two sides in view.
  std::vector<Point2> upright;
  /// Corners along the edge of the top that is before the sides in view, from left to right.
  std::vector<Point2> rim;
};

/// A place on the table and the width of what is there; metres.
struct Stand {
  double x = 0;
  double y = 0;
  double width = 0;
};

// Nothing if a part is not in front of the camera.

/// \param yaw in radians.
/// \param height in units of the width.
std::optional<OutlineModel> model_box(const Camera& camera, const Stand& stand, double yaw,
                                      double height);
std::optional<OutlineModel> model_cylinder(const Camera& camera, const Stand& stand, double height);
std::optional<OutlineModel> model_sphere(const Camera& camera, const Stand& stand);

/// Maps points of a model to the image: scale * point + shift. `deviation` is how far the supports
/// are apart then, pixels.
struct Alignment {
  double scale = 1;
  Point2 shift;
  double deviation = 0;

  Point2 operator()(const Point2& point) const {
    return {scale * point.x + shift.x, scale * point.y + shift.y};
  }
};

/// The alignment with the least deviation, by least squares, reweighted so that differences of more
/// than about `tolerance` pixels hardly count.
Alignment align(const Support& model, const Support& outline, double tolerance);

} // namespace castor::vision
