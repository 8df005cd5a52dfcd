#pragma once

#include "castor/mapping/geometry/solid.hpp"
#include "castor/mapping/geometry/types.hpp"

#include <string>

/// Solids that arms and what is on their tables are made of, for collision checks.
namespace castor::manipulation {

using geometry::Point3;
using geometry::Pose;

using geometry::Solid;
using geometry::SolidKind;

using geometry::box;
using geometry::capsule;
using geometry::cylinder;
using geometry::half_height;
using geometry::outer_radius;
using geometry::sphere;

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

} // namespace castor::manipulation
