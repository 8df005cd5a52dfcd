#pragma once

#include "castor/mapping/geometry/types.hpp"

#include <optional>
#include <string>

/// The geometry between a scene and an image of it: a pinhole camera with lens distortion. Points
/// are given in the frame of the camera's pose.
///
/// The lens model is Brown's (D. C. Brown, "Close-range camera calibration", 1971) in the form that
/// the common calibration tools estimate. On the plane at distance 1 before the camera, with
/// r^2 = x^2 + y^2 and q = 1 + k1 r^2 + k2 r^4 + k3 r^6, an ideal point (x, y) is seen at
///
///     ( x q + 2 t1 x y + t2 (r^2 + 2 x^2),  y q + t1 (r^2 + 2 y^2) + 2 t2 x y )
///
/// and from there the focal lengths and the principal point lead to pixels.
namespace castor::geometry {

/// A ray, metres; `direction` has length 1.
struct Ray {
  Point3 origin;
  Point3 direction;

  friend bool operator==(const Ray&, const Ray&) = default;
};

/// An undistorted camera at `eye` with `target` in the middle of its image and the horizon level
/// (the y axis upwards in the image, if it looks straight down or up).
///
/// \param vertical_fov_degrees the angle between the upper and the lower edge of the image.
/// \param width,height the image's size in pixels; pixels are square.
/// \param frame name of the frame of eye and target, if there is one.
/// \throws std::invalid_argument unless eye and target differ, the angle is in (0, 180) and the
///         size is positive.
Camera look_at(const Point3& eye, const Point3& target, double vertical_fov_degrees, int width,
               int height, std::string frame = {});

/// Assumed camera of a picture of a table without a calibration: its vertical angle is 50 degrees,
/// and it is 0.75 m before the middle of the table and 0.70 m above it, looking at that middle.
Camera nominal_camera(int width, int height);

/// Projection of `point`, in pixels; it may be outside of the image. Nothing if the point is behind
/// the camera, or so far off its axis that the lens model folds the image over itself.
std::optional<Point2> project(const Camera& camera, const Point3& point);

/// The viewing ray of `pixel`, from the camera's position. Nothing if the lens model has no ray for
/// that pixel, or if the camera has no focal length.
std::optional<Ray> viewing_ray(const Camera& camera, const Point2& pixel);

/// The point seen at `pixel`, if it lies on the plane z = `plane_z`. Nothing if the ray misses the
/// plane: at or above the horizon, or with the plane behind the camera.
std::optional<Point3> back_project(const Camera& camera, const Point2& pixel, double plane_z = 0);

} // namespace castor::geometry
