#include "castor/perception/spatial/scene_relations.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace castor::spatial {

std::vector<SpatialRelationship> relationships(SpatialRelation relation,
                                               std::span<const ScenePlace> places,
                                               const GroundPoint& viewer,
                                               const FieldOptions& options,
                                               const RelationThresholds& thresholds) {
  std::vector<GroundPoint> points;
  for (const auto& place : places)
    points.push_back(place.position);
  const PotentialFields fields(points, viewer, options);
  std::vector<SpatialRelationship> result;
  for (std::size_t target = 0; target < places.size(); ++target) {
    for (std::size_t landmark = 0; landmark < places.size(); ++landmark) {
      const double value = fields.value(relation, target, landmark);
      if (value > thresholds.of(relation))
        result.push_back({relation, places[target].location, places[landmark].location, value});
    }
  }
  return result;
}

const std::vector<SpatialRelationship>& list_of(const SpatialScene& scene,
                                                SpatialRelation relation) {
  switch (relation) {
    case SpatialRelation::near:
      return scene.near;
    case SpatialRelation::front:
      return scene.front;
    case SpatialRelation::back:
      return scene.back;
    case SpatialRelation::left:
      return scene.left;
    case SpatialRelation::right:
      return scene.right;
  }
  throw std::invalid_argument("no spatial relation has this number");
}

std::vector<SpatialRelationship>& list_of(SpatialScene& scene, SpatialRelation relation) {
  return const_cast<std::vector<SpatialRelationship>&>(list_of(std::as_const(scene), relation));
}

GroundPoint ground_point(const geometry::AlignedBox& box) {
  return {box.centroid.x, box.centroid.y};
}

bool is_free(const GroundPoint& static_point, std::span<const GroundPoint> objects,
             double min_distance) {
  return std::none_of(objects.begin(), objects.end(), [&](const GroundPoint& object) {
    return distance(static_point, object) < min_distance;
  });
}

} // namespace castor::spatial
