#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "castor/mapping/geometry/eigen_ray.hpp"
#include "castor/perception/vision/tabletop/tabletop_scene.hpp"

/// Intersections of rays with the bodies on the table. Private to the renderer, since it includes
/// Eigen.
namespace castor::vision {

/// Intersection of a ray with a body, where it enters.
struct BodyHit {
  /// Distance along the ray, metres.
  double distance = 0;
  /// Outward normal of length 1; near an edge it is tilted towards the neighbouring face, as for a
  /// slightly rounded edge.
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  /// Index of the body's face.
  int face = 0;
};

/// A convex body, prepared for intersections with many rays.
class Body {
public:
  explicit Body(const TabletopObject& object);

  /// The object with its middle at that pose of the table's frame.
  Body(const TabletopObject& object, const Pose& pose);

  /// A box along the table's axes.
  Body(const Eigen::Vector3d& centre, const Eigen::Vector3d& size);

  const Eigen::Vector3d& centre() const { return centre_; }

  /// Radius of the bounding sphere about the centre.
  double radius() const { return radius_; }

  std::optional<BodyHit> hit(const geometry::EigenRay& ray) const;

  /// Whether the ray meets the body between its origin and `limit`; false if it starts within.
  bool blocks(const geometry::EigenRay& ray,
              double limit = std::numeric_limits<double>::infinity()) const;

private:
  using Plane = Eigen::Hyperplane<double, 3>;

  struct Entry {
    double distance = 0;
    int face = 0;
  };

  void set_sides(const std::vector<Point2>& corners, double height);
  geometry::EigenRay to_body(const geometry::EigenRay& ray) const;
  std::optional<Entry> entry(const geometry::EigenRay& ray) const;
  std::optional<Entry> sphere_entry(const geometry::EigenRay& ray) const;
  std::optional<Entry> cylinder_entry(const geometry::EigenRay& ray) const;
  std::optional<Entry> sides_entry(const geometry::EigenRay& ray) const;
  Eigen::Vector3d normal_at(const Eigen::Vector3d& point, int face) const;

  enum class Kind { sphere, cylinder, sides };

  Kind kind_ = Kind::sides;
  Eigen::Vector3d centre_;
  /// From body coordinates, whose origin is the centre, to those of the table.
  Eigen::Matrix3d rotation_ = Eigen::Matrix3d::Identity();
  double radius_ = 0;
  double half_height_ = 0;
  /// Radius of a sphere or cylinder.
  double inner_radius_ = 0;
  /// Distance from an edge at which its rounding begins.
  double bevel_ = 0;
  /// Body coordinates; their normals point outwards.
  std::vector<Plane> sides_;
};

} // namespace castor::vision
