#pragma once

#include "castor/mapping/geometry/types.hpp"
#include "castor/wm/values/reflect.hpp"

#include <string>

/// Solids that arms and what is on their tables are made of.
namespace castor::geometry {

enum class SolidKind { box, cylinder, capsule, sphere };

std::string to_string(SolidKind kind);

/// A solid around its own origin. The axis of a cylinder or a capsule is z.
struct Solid {
  SolidKind kind = SolidKind::box;
  /// Lengths along x, y and z, metres. For all but boxes x and y are the diameter, and so is z of a
  /// sphere; z of a capsule includes its round ends.
  Point3 size;

  friend bool operator==(const Solid&, const Solid&) = default;
};

// Lengths are metres.

Solid box(double length, double width, double height);
Solid cylinder(double diameter, double height);
/// @param length with both round ends, at least the diameter
Solid capsule(double diameter, double length);
Solid sphere(double diameter);

/// Distance from the origin of a solid to the farthest of its points, metres.
double outer_radius(const Solid& solid);

/// Half the height of a solid that is turned like that, metres.
double half_height(const Solid& solid, const Rotation& rotation);

CASTOR_REFLECT_ENUM(SolidKind, box, cylinder, capsule, sphere)
CASTOR_REFLECT(Solid, kind, size)

} // namespace castor::geometry
