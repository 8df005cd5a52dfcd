#include "castor/perception/vision/camera/camera_model.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "castor/perception/vision/camera/camera_model_vectors.hpp"

namespace castor::vision {

using namespace vectors;

namespace {

bool is_distorted(const Camera& camera) {
  return camera.k1 != 0 || camera.k2 != 0 || camera.k3 != 0 || camera.t1 != 0 || camera.t2 != 0;
}

Point2 distort(const Camera& camera, const Point2& ideal) {
  const auto [x, y] = ideal;
  const double rr = x * x + y * y;
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
std::optional<Point2> undistort(const Camera& camera, const Point2& seen) {
  constexpr int max_iterations = 50;
  constexpr double tolerance = 1e-12;
  const auto miss = [&](const Point2& ideal) {
    const Point2 d = distort(camera, ideal);
    return std::hypot(d.x - seen.x, d.y - seen.y);
  };
  Point2 ideal = seen;
  if (!grows_up_to(camera, seen.x * seen.x + seen.y * seen.y))
    ideal = {};
  double error = miss(ideal);
  for (int i = 0; i < max_iterations && error > tolerance; ++i) {
    const auto [x, y] = ideal;
    const double rr = x * x + y * y;
    const double q = 1 + rr * (camera.k1 + rr * (camera.k2 + rr * camera.k3));
    const double dq = 2 * (camera.k1 + rr * (2 * camera.k2 + rr * 3 * camera.k3));
    const double xx = q + x * x * dq + 2 * camera.t1 * y + 6 * camera.t2 * x;
    const double yy = q + y * y * dq + 6 * camera.t1 * y + 2 * camera.t2 * x;
    const double xy = x * y * dq + 2 * camera.t1 * x + 2 * camera.t2 * y;
    const double determinant = xx * yy - xy * xy;
    if (determinant == 0)
      return std::nullopt;
    const Point2 d = distort(camera, ideal);
    const double ex = seen.x - d.x;
    const double ey = seen.y - d.y;
    Point2 step{(yy * ex - xy * ey) / determinant, (xx * ey - xy * ex) / determinant};
    Point2 next{x + step.x, y + step.y};
    double next_error = miss(next);
    for (int halving = 0; halving < 20 && !(next_error < error); ++halving) {
      step = {step.x / 2, step.y / 2};
      next = {x + step.x, y + step.y};
      next_error = miss(next);
    }
    if (!(next_error < error))
      break;
    ideal = next;
    error = next_error;
  }
  constexpr double acceptable = 1e-9;
  if (!(error < acceptable) || !grows_up_to(camera, ideal.x * ideal.x + ideal.y * ideal.y))
    return std::nullopt;
  return ideal;
}

} // namespace

Point3 rotate(const Rotation& rotation, const Point3& vector) {
  const Point3 axis{rotation.x, rotation.y, rotation.z};
  const Point3 t = 2.0 * cross(axis, vector);
  return vector + rotation.w * t + cross(axis, t);
}

Rotation inverse(const Rotation& rotation) {
  return {rotation.w, -rotation.x, -rotation.y, -rotation.z};
}

Rotation compose(const Rotation& a, const Rotation& b) {
  return {
    a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
    a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}

Rotation rotation_about_z(double radians) {
  return {std::cos(radians / 2), 0, 0, std::sin(radians / 2)};
}

Rotation rotation_from_axes(const Point3& x_axis, const Point3& y_axis, const Point3& z_axis) {
  // The largest of the four components is computed first, so that nothing is divided by a small
  // number (S. W. Shepperd, "Quaternion from rotation matrix", 1978).
  const double xx = x_axis.x;
  const double yy = y_axis.y;
  const double zz = z_axis.z;
  const double trace = xx + yy + zz;
  Rotation r;
  if (trace >= std::max({xx, yy, zz})) {
    const double s = 2 * std::sqrt(1 + trace);
    r = {s / 4, (y_axis.z - z_axis.y) / s, (z_axis.x - x_axis.z) / s, (x_axis.y - y_axis.x) / s};
  } else if (xx >= yy && xx >= zz) {
    const double s = 2 * std::sqrt(1 + xx - yy - zz);
    r = {(y_axis.z - z_axis.y) / s, s / 4, (x_axis.y + y_axis.x) / s, (x_axis.z + z_axis.x) / s};
  } else if (yy >= zz) {
    const double s = 2 * std::sqrt(1 - xx + yy - zz);
    r = {(z_axis.x - x_axis.z) / s, (x_axis.y + y_axis.x) / s, s / 4, (y_axis.z + z_axis.y) / s};
  } else {
    const double s = 2 * std::sqrt(1 - xx - yy + zz);
    r = {(x_axis.y - y_axis.x) / s, (x_axis.z + z_axis.x) / s, (y_axis.z + z_axis.y) / s, s / 4};
  }
  const double length = std::sqrt(r.w * r.w + r.x * r.x + r.y * r.y + r.z * r.z);
  return {r.w / length, r.x / length, r.y / length, r.z / length};
}

Camera look_at(const Point3& eye, const Point3& target, double vertical_fov_degrees, int width,
               int height) {
  if (!(norm(target - eye) > 0))
    throw std::invalid_argument("look_at: the camera's position and its target are the same point");
  if (!(vertical_fov_degrees > 0 && vertical_fov_degrees < 180))
    throw std::invalid_argument("look_at: the vertical field of view must be between 0 and 180 "
                                "degrees");
  if (width <= 0 || height <= 0)
    throw std::invalid_argument("look_at: the image must have a positive width and height");
  const Point3 forward = normalized(target - eye);
  constexpr double nearly_vertical = 1e-6;
  Point3 right = cross(forward, {0, 0, 1});
  right = norm(right) > nearly_vertical ? normalized(right) : normalized(cross(forward, {0, 1, 0}));
  const Point3 down = cross(forward, right);
  Camera camera;
  camera.pose = {eye, rotation_from_axes(right, down, forward)};
  camera.width = width;
  camera.height = height;
  camera.fx = height / (2 * std::tan(vertical_fov_degrees * std::numbers::pi / 360));
  camera.fy = camera.fx;
  camera.cx = (width - 1) / 2.0;
  camera.cy = (height - 1) / 2.0;
  return camera;
}

Camera nominal_camera(int width, int height) {
  return look_at({0, -0.75, 0.70}, {0, 0, 0}, 50, width, height);
}

std::optional<Point2> project(const Camera& camera, const Point3& point) {
  const Point3 body = rotate(inverse(camera.pose.rotation), point - camera.pose.position);
  if (!(body.z > 0))
    return std::nullopt;
  Point2 seen{body.x / body.z, body.y / body.z};
  if (is_distorted(camera)) {
    if (!grows_up_to(camera, seen.x * seen.x + seen.y * seen.y))
      return std::nullopt;
    seen = distort(camera, seen);
  }
  return Point2{camera.fx * seen.x + camera.cx, camera.fy * seen.y + camera.cy};
}

std::optional<Ray> viewing_ray(const Camera& camera, const Point2& pixel) {
  if (!(camera.fx > 0 && camera.fy > 0))
    return std::nullopt;
  Point2 ideal{(pixel.x - camera.cx) / camera.fx, (pixel.y - camera.cy) / camera.fy};
  if (is_distorted(camera)) {
    const auto undistorted = undistort(camera, ideal);
    if (!undistorted)
      return std::nullopt;
    ideal = *undistorted;
  }
  return Ray{camera.pose.position, rotate(camera.pose.rotation, normalized({ideal.x, ideal.y, 1}))};
}

std::optional<Point3> back_project(const Camera& camera, const Point2& pixel, double plane_z) {
  const auto ray = viewing_ray(camera, pixel);
  if (!ray)
    return std::nullopt;
  const double distance = (plane_z - ray->origin.z) / ray->direction.z;
  if (!(distance > 0) || !std::isfinite(distance))
    return std::nullopt;
  Point3 point = ray->origin + distance * ray->direction;
  point.z = plane_z;
  return point;
}

} // namespace castor::vision
