#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "castor/perception/vision/camera/camera_model.hpp"
#include "castor/perception/vision/tabletop/tabletop_scene.hpp"

/// Intersections of rays with the bodies on the table.
namespace castor::vision {

/// Intersection of a ray with a body, where it enters.
struct BodyHit {
  /// Distance along the ray, metres.
  double distance = 0;
  /// Outward normal of length 1; near an edge it is tilted towards the neighbouring face, as for a
  /// slightly rounded edge.
  Point3 normal;
  /// Index of the body's face.
  int face = 0;
};

/// A convex, upright body, prepared for intersections with many rays.
class Body {
public:
  explicit Body(const TabletopObject& object);

  /// A box along the table's axes.
  Body(const Point3& centre, const Point3& size);

  const Point3& centre() const { return centre_; }

  /// Radius of the bounding sphere about the centre.
  double radius() const { return radius_; }

  std::optional<BodyHit> hit(const Ray& ray) const;

  /// Whether the ray meets the body between its origin and `limit`; false if it starts within.
  bool blocks(const Ray& ray, double limit = std::numeric_limits<double>::infinity()) const;

private:
  /// A half space; body coordinates.
  struct Side {
    Point3 normal;
    double offset = 0;
  };

  struct Entry {
    double distance = 0;
    int face = 0;
  };

  void set_sides(const std::vector<Point2>& corners, double height);
  Ray to_body(const Ray& ray) const;
  std::optional<Entry> entry(const Ray& ray) const;
  std::optional<Entry> sphere_entry(const Ray& ray) const;
  std::optional<Entry> cylinder_entry(const Ray& ray) const;
  std::optional<Entry> sides_entry(const Ray& ray) const;
  Point3 normal_at(const Point3& point, int face) const;

  enum class Kind { sphere, cylinder, sides };

  Kind kind_ = Kind::sides;
  Point3 centre_;
  double cosine_ = 1;
  double sine_ = 0;
  double radius_ = 0;
  double half_height_ = 0;
  /// Radius of a sphere or cylinder.
  double inner_radius_ = 0;
  /// Distance from an edge at which its rounding begins.
  double bevel_ = 0;
  std::vector<Side> sides_;
};

} // namespace castor::vision
