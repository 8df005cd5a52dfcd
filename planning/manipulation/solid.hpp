#pragma once

#include "castor/mapping/geometry/types.hpp"

#include <string>
#include <vector>

/// Solids that arms and what is on their tables are made of, for collision checks.
namespace castor::manipulation {

using geometry::Point3;
using geometry::Pose;

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

/// A solid and where it is: on a link, in the tool's frame, or in the arm's.
struct PlacedSolid {
  Solid solid;
  Pose pose;

  friend bool operator==(const PlacedSolid&, const PlacedSolid&) = default;
};

/// A thing with a name, which errors mention: "the red box". Its pose is in the arm's frame.
struct NamedSolid {
  std::string name;
  Solid solid;
  Pose pose;
  /// How much further its surface may be out than the solid says; metres. Who moves past it keeps
  /// that much more away.
  double uncertainty = 0;
  /// How much further along its own z axis it may reach, metres: what a camera sees from above may
  /// be higher than it seems.
  double higher = 0;

  friend bool operator==(const NamedSolid&, const NamedSolid&) = default;
};

/// As high as the thing may be, with the same foot.
PlacedSolid highest(const NamedSolid& thing);

/// Distance from the origin of a solid to the farthest of its points, metres.
double outer_radius(const Solid& solid);

/// Half the height of a solid that is turned like that, metres.
double half_height(const Solid& solid, const geometry::Rotation& rotation);

} // namespace castor::manipulation
