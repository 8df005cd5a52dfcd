#include "castor/mapping/geometry/poses.hpp"

#include "castor/mapping/geometry/eigen_bridge.hpp"

#include <cmath>
#include <utility>

namespace castor::geometry {

Point3 rotate(const Rotation& rotation, const Point3& vector) {
  return to_point(to_eigen(rotation) * to_eigen(vector));
}

Rotation inverse(const Rotation& rotation) {
  return to_rotation(to_eigen(rotation).conjugate());
}

Rotation compose(const Rotation& first, const Rotation& second) {
  return to_rotation(to_eigen(first) * to_eigen(second));
}

Rotation rotation_about_z(double radians) {
  return {std::cos(radians / 2), 0, 0, std::sin(radians / 2)};
}

Rotation rotation_from_axes(const Point3& x_axis, const Point3& y_axis, const Point3& z_axis) {
  Eigen::Matrix3d axes;
  axes << to_eigen(x_axis), to_eigen(y_axis), to_eigen(z_axis);
  return to_rotation(Eigen::Quaterniond(axes).normalized());
}

double angle_between(const Rotation& a, const Rotation& b) {
  return to_eigen(a).angularDistance(to_eigen(b));
}

Rotation interpolate(const Rotation& from, const Rotation& to, double share) {
  return to_rotation(to_eigen(from).slerp(share, to_eigen(to)));
}

Point3 transform(const Pose& body, const Point3& point) {
  return to_point(to_eigen(body.rotation) * to_eigen(point) + to_eigen(body.position));
}

Pose compose(const Pose& body, const Pose& thing) {
  return {transform(body, thing.position), compose(body.rotation, thing.rotation), body.frame};
}

Pose inverse(const Pose& body, std::string name) {
  const auto back = to_eigen(body.rotation).conjugate();
  return {to_point(back * -to_eigen(body.position)), to_rotation(back), std::move(name)};
}

Pose interpolate(const Pose& from, const Pose& to, double share) {
  const auto a = to_eigen(from.position);
  return {to_point(a + share * (to_eigen(to.position) - a)),
          interpolate(from.rotation, to.rotation, share), from.frame};
}

AlignedBox transform(const Pose& body, const AlignedBox& box) {
  // Half the size along an axis is that of the body's axes, as far as they point along it.
  const Eigen::Matrix3d shares = to_eigen(body.rotation).toRotationMatrix().cwiseAbs();
  return {transform(body, box.centroid), to_point(shares * to_eigen(box.size)), body.frame};
}

double distance(const Point3& a, const Point3& b) {
  return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z);
}

} // namespace castor::geometry
