#pragma once

#include "castor/perception/spatial/types.hpp"

#include <optional>

namespace castor::spatial {

/// Directions on the ground for a viewer who looks along `back`; unit vectors.
///
/// Relations by these directions are as in the CLEVR corpus (J. Johnson et al., "CLEVR: A
/// diagnostic dataset for compositional language and elementary visual reasoning", 2017): they
/// depend on directions only, not on distances or other objects, and the directions are the same
/// for all landmarks.
struct GroundDirections {
  GroundPoint front;
  GroundPoint back;
  GroundPoint left;
  GroundPoint right;
};

/// The directions for a viewer whose body coordinates are those of a camera: x to the right, y
/// down, z forward. Nothing if it looks straight up or down.
std::optional<GroundDirections> ground_directions(const geometry::Pose& viewer);

/// The directions that a viewer speaks of: those of ground_directions(); else, if it looks straight
/// down, those of its image; else those from where it stands to the origin. Nothing if it looks
/// straight up from above the origin.
std::optional<GroundDirections> viewing_directions(const geometry::Pose& viewer);

/// A point as seen by a viewer: x to the right, y away from it; metres from the origin.
GroundPoint as_seen(const GroundDirections& directions, const GroundPoint& point);

/// How far the target is to that side of the landmark, metres; negative on the other side.
/// \pre `relation` is not near, which is no direction.
double distance_to_side(const GroundDirections& directions, SpatialRelation relation,
                        const GroundPoint& target, const GroundPoint& landmark);

/// Whether the target is on that side of the landmark by more than `margin` metres.
/// \pre as for distance_to_side().
bool is_on_side(const GroundDirections& directions, SpatialRelation relation,
                const GroundPoint& target, const GroundPoint& landmark, double margin = 0);

} // namespace castor::spatial
