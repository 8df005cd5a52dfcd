#include "castor/perception/vision/tabletop/tabletop_renderer_body.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "castor/perception/vision/camera/camera_model_vectors.hpp"

namespace castor::vision {

using namespace vectors;

namespace {

/// Of the smallest extent.
constexpr double bevel_fraction = 0.07;

double bevel_of(const Point3& size) {
  return bevel_fraction * std::max(std::min({size.x, size.y, size.z}), 0.01);
}

} // namespace

Body::Body(const TabletopObject& object)
  : centre_(pose_of(object).position), half_height_(object.size.z / 2),
    bevel_(bevel_of(object.size)) {
  const double turn = object.turned_degrees * std::numbers::pi / 180;
  cosine_ = std::cos(turn);
  sine_ = std::sin(turn);
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

Body::Body(const Point3& centre, const Point3& size)
  : centre_(centre), half_height_(size.z / 2), bevel_(bevel_of(size)) {
  const double x = size.x / 2;
  const double y = size.y / 2;
  set_sides({{-x, -y}, {x, -y}, {x, y}, {-x, y}}, size.z);
}

void Body::set_sides(const std::vector<Point2>& corners, double height) {
  sides_ = {{{0, 0, 1}, height / 2}, {{0, 0, -1}, height / 2}};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Point2& from = corners[i];
    const Point2& to = corners[(i + 1) % corners.size()];
    const Point3 normal = normalized({to.y - from.y, from.x - to.x, 0});
    sides_.push_back({normal, normal.x * from.x + normal.y * from.y});
    radius_ = std::max(radius_, std::hypot(from.x, from.y, height / 2));
  }
}

Ray Body::to_body(const Ray& ray) const {
  const auto turned = [&](const Point3& v) {
    return Point3{cosine_ * v.x + sine_ * v.y, cosine_ * v.y - sine_ * v.x, v.z};
  };
  return {turned(ray.origin - centre_), turned(ray.direction)};
}

std::optional<BodyHit> Body::hit(const Ray& ray) const {
  const Ray body_ray = to_body(ray);
  const auto found = entry(body_ray);
  if (!found)
    return std::nullopt;
  const Point3 n = normal_at(body_ray.origin + found->distance * body_ray.direction, found->face);
  return BodyHit{
    found->distance, {cosine_ * n.x - sine_ * n.y, sine_ * n.x + cosine_ * n.y, n.z}, found->face};
}

bool Body::blocks(const Ray& ray, double limit) const {
  const auto found = entry(to_body(ray));
  return found && found->distance < limit;
}

std::optional<Body::Entry> Body::entry(const Ray& ray) const {
  const double along = dot(ray.origin, ray.direction);
  if (dot(ray.origin, ray.origin) - along * along > radius_ * radius_)
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

std::optional<Body::Entry> Body::sphere_entry(const Ray& ray) const {
  const double along = dot(ray.origin, ray.direction);
  const double discriminant =
    along * along - dot(ray.origin, ray.origin) + inner_radius_ * inner_radius_;
  if (discriminant < 0)
    return std::nullopt;
  const double distance = -along - std::sqrt(discriminant);
  if (!(distance > 0))
    return std::nullopt;
  return Entry{distance, 0};
}

std::optional<Body::Entry> Body::cylinder_entry(const Ray& ray) const {
  const auto& [o, d] = ray;
  double enter = -std::numeric_limits<double>::infinity();
  double leave = -enter;
  int face = 0;
  if (d.z != 0) {
    enter = (std::copysign(half_height_, -d.z) - o.z) / d.z;
    leave = (std::copysign(half_height_, d.z) - o.z) / d.z;
    face = d.z < 0 ? 0 : 1;
  } else if (std::abs(o.z) > half_height_) {
    return std::nullopt;
  }
  const double a = d.x * d.x + d.y * d.y;
  const double c = o.x * o.x + o.y * o.y - inner_radius_ * inner_radius_;
  if (a > 0) {
    const double b = o.x * d.x + o.y * d.y;
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

std::optional<Body::Entry> Body::sides_entry(const Ray& ray) const {
  double enter = -std::numeric_limits<double>::infinity();
  double leave = -enter;
  int face = 0;
  for (std::size_t i = 0; i < sides_.size(); ++i) {
    const double height = dot(sides_[i].normal, ray.origin) - sides_[i].offset;
    const double slope = dot(sides_[i].normal, ray.direction);
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

Point3 Body::normal_at(const Point3& point, int face) const {
  // Towards a neighbour whose plane is `depth` below the point: half of each at the edge itself.
  const auto lean = [&](double depth) {
    const double t = std::clamp(1 - depth / bevel_, 0.0, 1.0);
    return t * t;
  };
  if (kind_ == Kind::sphere)
    return normalized(point);
  if (kind_ == Kind::cylinder) {
    const double distance = std::hypot(point.x, point.y);
    const Point3 outwards =
      distance > 0 ? Point3{point.x / distance, point.y / distance, 0} : Point3{};
    if (face == 2) {
      const double below = lean(half_height_ - point.z);
      const double above = lean(half_height_ + point.z);
      return normalized(outwards + Point3{0, 0, below - above});
    }
    return normalized(Point3{0, 0, face == 0 ? 1.0 : -1.0} +
                      lean(inner_radius_ - distance) * outwards);
  }
  Point3 normal = sides_[static_cast<std::size_t>(face)].normal;
  for (std::size_t i = 0; i < sides_.size(); ++i)
    if (static_cast<int>(i) != face)
      normal = normal + lean(sides_[i].offset - dot(sides_[i].normal, point)) * sides_[i].normal;
  return normalized(normal);
}

} // namespace castor::vision
