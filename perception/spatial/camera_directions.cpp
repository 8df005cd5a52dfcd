#include "castor/perception/spatial/camera_directions.hpp"

#include <cmath>

namespace castor::spatial {

std::optional<GroundDirections> ground_directions(const vision::Pose& viewer) {
  // Where the rotation takes the z axis, seen from above.
  const auto& q = viewer.rotation;
  const double x = 2 * (q.x * q.z + q.w * q.y);
  const double y = 2 * (q.y * q.z - q.w * q.x);
  const double length = std::hypot(x, y);
  if (!(length > 1e-9))
    return std::nullopt;
  const GroundPoint back{x / length, y / length};
  return GroundDirections{{-back.x, -back.y}, back, {-back.y, back.x}, {back.y, -back.x}};
}

double distance_to_side(const GroundDirections& directions, SpatialRelation relation,
                        const GroundPoint& target, const GroundPoint& landmark) {
  GroundPoint direction;
  switch (relation) {
    case SpatialRelation::front:
      direction = directions.front;
      break;
    case SpatialRelation::back:
      direction = directions.back;
      break;
    case SpatialRelation::left:
      direction = directions.left;
      break;
    case SpatialRelation::right:
      direction = directions.right;
      break;
    case SpatialRelation::near:
      break;
  }
  return direction.x * (target.x - landmark.x) + direction.y * (target.y - landmark.y);
}

bool is_on_side(const GroundDirections& directions, SpatialRelation relation,
                const GroundPoint& target, const GroundPoint& landmark, double margin) {
  return distance_to_side(directions, relation, target, landmark) > margin;
}

} // namespace castor::spatial
