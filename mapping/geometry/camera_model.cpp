#include "castor/mapping/geometry/camera_model.hpp"

#include "castor/mapping/geometry/eigen_bridge.hpp"
#include "castor/mapping/geometry/poses.hpp"

#include <Eigen/LU>

#include <cmath>
#include <numbers>
#include <stdexcept>
#include <utility>

namespace castor::geometry {

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

bool is_distorted(const Camera& camera) {
  return camera.k1 != 0 || camera.k2 != 0 || camera.k3 != 0 || camera.t1 != 0 || camera.t2 != 0;
}

Vector2d distort(const Camera& camera, const Vector2d& ideal) {
  const double x = ideal.x();
  const double y = ideal.y();
  const double rr = ideal.squaredNorm();
  const double q = 1 + rr * (camera.k1 + rr * (camera.k2 + rr * camera.k3));
  return {x * q + 2 * camera.t1 * x * y + camera.t2 * (rr + 2 * x * x),
          y * q + camera.t1 * (rr + 2 * y * y) + 2 * camera.t2 * x * y};
}

/// Whether the radial distortion still grows everywhere from the axis out to the squared radius
/// `rr`: the derivative of r q(r) is a cubic in rr, smallest at an end or where its own derivative
/// is zero.
bool grows_up_to(const Camera& camera, double rr) {
  const auto derivative = [&](double s) {
    return 1 + s * (3 * camera.k1 + s * (5 * camera.k2 + s * 7 * camera.k3));
  };
  if (derivative(rr) <= 0)
    return false;
  const double a = 21 * camera.k3;
  const double b = 10 * camera.k2;
  const double c = 3 * camera.k1;
  const auto fine = [&](double s) { return !(s > 0 && s < rr) || derivative(s) > 0; };
  if (a == 0)
    return b == 0 || fine(-c / b);
  const double discriminant = b * b - 4 * a * c;
  if (discriminant < 0)
    return true;
  const double root = std::sqrt(discriminant);
  return fine((-b + root) / (2 * a)) && fine((-b - root) / (2 * a));
}

/// Newton's method with halved steps; nothing if it finds no ideal point in the lens model's
/// domain.
std::optional<Vector2d> undistort(const Camera& camera, const Vector2d& seen) {
  constexpr int max_iterations = 50;
  constexpr double tolerance = 1e-12;
  const auto miss = [&](const Vector2d& ideal) { return (distort(camera, ideal) - seen).norm(); };
  Vector2d ideal = seen;
  if (!grows_up_to(camera, seen.squaredNorm()))
    ideal.setZero();
  double error = miss(ideal);
  for (int i = 0; i < max_iterations && error > tolerance; ++i) {
    const double x = ideal.x();
    const double y = ideal.y();
    const double rr = ideal.squaredNorm();
    const double q = 1 + rr * (camera.k1 + rr * (camera.k2 + rr * camera.k3));
    const double dq = 2 * (camera.k1 + rr * (2 * camera.k2 + rr * 3 * camera.k3));
    const double xx = q + x * x * dq + 2 * camera.t1 * y + 6 * camera.t2 * x;
    const double yy = q + y * y * dq + 6 * camera.t1 * y + 2 * camera.t2 * x;
    const double xy = x * y * dq + 2 * camera.t1 * x + 2 * camera.t2 * y;
    const Eigen::Matrix2d jacobian{{xx, xy}, {xy, yy}};
    if (jacobian.determinant() == 0)
      return std::nullopt;
    Vector2d step = jacobian.inverse() * (seen - distort(camera, ideal));
    Vector2d next = ideal + step;
    double next_error = miss(next);
    for (int halving = 0; halving < 20 && !(next_error < error); ++halving) {
      step /= 2;
      next = ideal + step;
      next_error = miss(next);
    }
    if (!(next_error < error))
      break;
    ideal = next;
    error = next_error;
  }
  constexpr double acceptable = 1e-9;
  if (!(error < acceptable) || !grows_up_to(camera, ideal.squaredNorm()))
    return std::nullopt;
  return ideal;
}

} // namespace

Camera look_at(const Point3& eye, const Point3& target, double vertical_fov_degrees, int width,
               int height, std::string frame) {
  const Vector3d way = to_eigen(target) - to_eigen(eye);
  if (!(way.norm() > 0))
    throw std::invalid_argument("look_at: the camera's position and its target are the same point");
  if (!(vertical_fov_degrees > 0 && vertical_fov_degrees < 180))
    throw std::invalid_argument("look_at: the vertical field of view must be between 0 and 180 "
                                "degrees");
  if (width <= 0 || height <= 0)
    throw std::invalid_argument("look_at: the image must have a positive width and height");
  const Vector3d forward = way.normalized();
  constexpr double nearly_vertical = 1e-6;
  Vector3d right = forward.cross(Vector3d::UnitZ());
  if (!(right.norm() > nearly_vertical))
    right = forward.cross(Vector3d::UnitY());
  right.normalize();
  const Vector3d down = forward.cross(right);
  Camera camera;
  camera.pose = {eye, rotation_from_axes(to_point(right), to_point(down), to_point(forward)),
                 std::move(frame)};
  camera.width = width;
  camera.height = height;
  camera.fx = height / (2 * std::tan(vertical_fov_degrees * std::numbers::pi / 360));
  camera.fy = camera.fx;
  camera.cx = (width - 1) / 2.0;
  camera.cy = (height - 1) / 2.0;
  return camera;
}

Camera nominal_camera(int width, int height) {
  Camera camera = look_at({0, -0.75, 0.70}, {0, 0, 0}, 50, width, height, table_frame);
  camera.is_assumed = true;
  return camera;
}

std::optional<Point2> project(const Camera& camera, const Point3& point) {
  const Vector3d body =
    to_eigen(camera.pose.rotation).conjugate() * (to_eigen(point) - to_eigen(camera.pose.position));
  if (!(body.z() > 0))
    return std::nullopt;
  Vector2d seen = body.hnormalized();
  if (is_distorted(camera)) {
    if (!grows_up_to(camera, seen.squaredNorm()))
      return std::nullopt;
    seen = distort(camera, seen);
  }
  return Point2{camera.fx * seen.x() + camera.cx, camera.fy * seen.y() + camera.cy};
}

std::optional<Ray> viewing_ray(const Camera& camera, const Point2& pixel) {
  if (!(camera.fx > 0 && camera.fy > 0))
    return std::nullopt;
  Vector2d ideal((pixel.x - camera.cx) / camera.fx, (pixel.y - camera.cy) / camera.fy);
  if (is_distorted(camera)) {
    const auto undistorted = undistort(camera, ideal);
    if (!undistorted)
      return std::nullopt;
    ideal = *undistorted;
  }
  const Vector3d direction = ideal.homogeneous();
  return Ray{camera.pose.position,
             to_point(to_eigen(camera.pose.rotation) * direction.normalized())};
}

std::optional<Point3> back_project(const Camera& camera, const Point2& pixel, double plane_z) {
  const auto ray = viewing_ray(camera, pixel);
  if (!ray)
    return std::nullopt;
  const double distance = (plane_z - ray->origin.z) / ray->direction.z;
  if (!(distance > 0) || !std::isfinite(distance))
    return std::nullopt;
  Point3 point = to_point(to_eigen(ray->origin) + distance * to_eigen(ray->direction));
  point.z = plane_z;
  return point;
}

} // namespace castor::geometry
