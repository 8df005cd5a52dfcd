#include "castor/perception/vision/tabletop/tabletop_renderer_body.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace castor::vision {

using namespace geometry;

using Eigen::Vector3d;

namespace {

/// Of the smallest extent.
constexpr double bevel_fraction = 0.07;

double bevel_of(const Vector3d& size) {
  return bevel_fraction * std::max(size.minCoeff(), 0.01);
}

} // namespace

Body::Body(const TabletopObject& object) : Body(object, pose_of(object)) {
  // nop
}

Body::Body(const TabletopObject& object, const Pose& pose)
  : centre_(to_eigen(pose.position)), rotation_(to_eigen(pose.rotation).normalized()),
    half_height_(object.size.z / 2), bevel_(bevel_of(to_eigen(object.size))) {
  switch (object.shape) {
    case TabletopShape::sphere:
      kind_ = Kind::sphere;
      inner_radius_ = half_height_;
      radius_ = half_height_;
      break;
    case TabletopShape::cylinder:
    case TabletopShape::disc:
      kind_ = Kind::cylinder;
      inner_radius_ = object.size.x / 2;
      radius_ = std::hypot(inner_radius_, half_height_);
      break;
    default: {
      TabletopObject upright = object;
      upright.x = upright.y = upright.turned_degrees = 0;
      set_sides(footprint(upright), object.size.z);
    }
  }
}

Body::Body(const Vector3d& centre, const Vector3d& size)
  : centre_(centre), half_height_(size.z() / 2), bevel_(bevel_of(size)) {
  const double x = size.x() / 2;
  const double y = size.y() / 2;
  set_sides({{-x, -y}, {x, -y}, {x, y}, {-x, y}}, size.z());
}

void Body::set_sides(const std::vector<Point2>& corners, double height) {
  const Vector3d top(0, 0, height / 2);
  sides_ = {{Vector3d::UnitZ(), top}, {-Vector3d::UnitZ(), -top}};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Point2& from = corners[i];
    const Point2& to = corners[(i + 1) % corners.size()];
    const Vector3d normal = Vector3d(to.y - from.y, from.x - to.x, 0).normalized();
    sides_.emplace_back(normal, Vector3d(from.x, from.y, 0));
    radius_ = std::max(radius_, std::hypot(from.x, from.y, height / 2));
  }
}

EigenRay Body::to_body(const EigenRay& ray) const {
  return {rotation_.transpose() * (ray.origin() - centre_),
          rotation_.transpose() * ray.direction()};
}

std::optional<BodyHit> Body::hit(const EigenRay& ray) const {
  const EigenRay body_ray = to_body(ray);
  const auto found = entry(body_ray);
  if (!found)
    return std::nullopt;
  const Vector3d normal = normal_at(body_ray.pointAt(found->distance), found->face);
  return BodyHit{found->distance, rotation_ * normal, found->face};
}

bool Body::blocks(const EigenRay& ray, double limit) const {
  const auto found = entry(to_body(ray));
  return found && found->distance < limit;
}

std::optional<Body::Entry> Body::entry(const EigenRay& ray) const {
  const double along = ray.origin().dot(ray.direction());
  if (ray.origin().squaredNorm() - along * along > radius_ * radius_)
    return std::nullopt;
  switch (kind_) {
    case Kind::sphere:
      return sphere_entry(ray);
    case Kind::cylinder:
      return cylinder_entry(ray);
    case Kind::sides:
      break;
  }
  return sides_entry(ray);
}

std::optional<Body::Entry> Body::sphere_entry(const EigenRay& ray) const {
  const double along = ray.origin().dot(ray.direction());
  const double discriminant =
    along * along - ray.origin().squaredNorm() + inner_radius_ * inner_radius_;
  if (discriminant < 0)
    return std::nullopt;
  const double distance = -along - std::sqrt(discriminant);
  if (!(distance > 0))
    return std::nullopt;
  return Entry{distance, 0};
}

std::optional<Body::Entry> Body::cylinder_entry(const EigenRay& ray) const {
  const Vector3d& o = ray.origin();
  const Vector3d& d = ray.direction();
  double enter = -std::numeric_limits<double>::infinity();
  double leave = -enter;
  int face = 0;
  if (d.z() != 0) {
    enter = (std::copysign(half_height_, -d.z()) - o.z()) / d.z();
    leave = (std::copysign(half_height_, d.z()) - o.z()) / d.z();
    face = d.z() < 0 ? 0 : 1;
  } else if (std::abs(o.z()) > half_height_) {
    return std::nullopt;
  }
  const double a = d.head<2>().squaredNorm();
  const double c = o.head<2>().squaredNorm() - inner_radius_ * inner_radius_;
  if (a > 0) {
    const double b = o.head<2>().dot(d.head<2>());
    const double discriminant = b * b - a * c;
    if (discriminant < 0)
      return std::nullopt;
    const double root = std::sqrt(discriminant);
    if ((-b - root) / a > enter) {
      enter = (-b - root) / a;
      face = 2;
    }
    leave = std::min(leave, (-b + root) / a);
  } else if (c > 0) {
    return std::nullopt;
  }
  if (!(enter > 0) || !(enter < leave))
    return std::nullopt;
  return Entry{enter, face};
}

std::optional<Body::Entry> Body::sides_entry(const EigenRay& ray) const {
  double enter = -std::numeric_limits<double>::infinity();
  double leave = -enter;
  int face = 0;
  for (std::size_t i = 0; i < sides_.size(); ++i) {
    const double height = sides_[i].signedDistance(ray.origin());
    const double slope = sides_[i].normal().dot(ray.direction());
    if (slope == 0) {
      if (height > 0)
        return std::nullopt;
    } else if (slope < 0) {
      if (const double distance = -height / slope; distance > enter) {
        enter = distance;
        face = static_cast<int>(i);
      }
    } else {
      leave = std::min(leave, -height / slope);
    }
    if (!(enter < leave))
      return std::nullopt;
  }
  if (!(enter > 0))
    return std::nullopt;
  return Entry{enter, face};
}

Vector3d Body::normal_at(const Vector3d& point, int face) const {
  // Towards a neighbour whose plane is `depth` below the point: half of each at the edge itself.
  const auto lean = [&](double depth) {
    const double t = std::clamp(1 - depth / bevel_, 0.0, 1.0);
    return t * t;
  };
  if (kind_ == Kind::sphere)
    return point.normalized();
  if (kind_ == Kind::cylinder) {
    const Vector3d from_axis(point.x(), point.y(), 0);
    // Zero on the axis itself.
    const Vector3d outwards = from_axis.normalized();
    if (face == 2) {
      const double below = lean(half_height_ - point.z());
      const double above = lean(half_height_ + point.z());
      return (outwards + (below - above) * Vector3d::UnitZ()).normalized();
    }
    const Vector3d upright(0, 0, face == 0 ? 1 : -1);
    return (upright + lean(inner_radius_ - from_axis.norm()) * outwards).normalized();
  }
  Vector3d normal = sides_[static_cast<std::size_t>(face)].normal();
  for (std::size_t i = 0; i < sides_.size(); ++i)
    if (static_cast<int>(i) != face)
      normal += lean(-sides_[i].signedDistance(point)) * sides_[i].normal();
  return normal.normalized();
}

} // namespace castor::vision
