#pragma once

#include "castor/perception/spatial/potential_fields.hpp"
#include "castor/perception/spatial/types.hpp"

#include <span>
#include <string>
#include <vector>

namespace castor::spatial {

/// A place in a scene, by the id of its SpatialLocation.
struct ScenePlace {
  std::string location;
  GroundPoint position;
};

/// All pairs of places for which the relation holds by potential fields, in the order of the
/// places: targets first, landmarks within.
std::vector<SpatialRelationship> relationships(SpatialRelation relation,
                                               std::span<const ScenePlace> places,
                                               const GroundPoint& viewer,
                                               const FieldOptions& options = {},
                                               const RelationThresholds& thresholds = {});

/// The scene's list for a relation.
std::vector<SpatialRelationship>& list_of(SpatialScene& scene, SpatialRelation relation);
const std::vector<SpatialRelationship>& list_of(const SpatialScene& scene,
                                                SpatialRelation relation);

/// The centre of a box, from above.
GroundPoint ground_point(const geometry::AlignedBox& box);

/// Whether a static point is part of a scene: those closer than `min_distance` metres to an object
/// are replaced by the object.
bool is_free(const GroundPoint& static_point, std::span<const GroundPoint> objects,
             double min_distance = 0.03);

} // namespace castor::spatial
