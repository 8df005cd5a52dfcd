#pragma once

#include <limits>
#include <optional>
#include <vector>

#include "castor/perception/vision/camera/camera_model.hpp"
#include "castor/perception/vision/tabletop/tabletop_scene.hpp"

/// Where rays meet the bodies on the table.
namespace castor::vision {

/// Where a ray enters a body.
struct BodyHit {
  /// Along the ray, metres.
  double distance = 0;
  /// Of length 1, outwards; near an edge it leans over to the neighbouring face, as if the edge
  /// were slightly rounded.
  Point3 normal;
  /// Which face of the body it is.
  int face = 0;
};

/// A convex body that stands upright, ready to be asked for many rays.
class Body {
public:
  explicit Body(const TabletopObject& object);

  /// A box along the table's axes.
  Body(const Point3& centre, const Point3& size);

  const Point3& centre() const { return centre_; }

  /// Of a sphere about the centre that holds the body.
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
  /// Of a sphere or cylinder.
  double inner_radius_ = 0;
  /// How far from an edge its rounding begins.
  double bevel_ = 0;
  std::vector<Side> sides_;
};

} // namespace castor::vision
