#include "castor/perception/spatial/camera_directions.hpp"

#include <cmath>

namespace castor::spatial {

namespace {

/// Directions with `back` along a vector; nothing if that is zero.
std::optional<GroundDirections> directions_along(double x, double y) {
  const double length = std::hypot(x, y);
  if (!(length > 1e-9))
    return std::nullopt;
  const GroundPoint back{x / length, y / length};
  return GroundDirections{{-back.x, -back.y}, back, {-back.y, back.x}, {back.y, -back.x}};
}

} // namespace

std::optional<GroundDirections> ground_directions(const geometry::Pose& viewer) {
  // Where the rotation takes the z axis, seen from above.
  const auto& q = viewer.rotation;
  return directions_along(2 * (q.x * q.z + q.w * q.y), 2 * (q.y * q.z - q.w * q.x));
}

std::optional<GroundDirections> viewing_directions(const geometry::Pose& viewer) {
  if (auto result = ground_directions(viewer))
    return result;
  const auto& q = viewer.rotation;
  const double upwards = 1 - 2 * (q.x * q.x + q.y * q.y);
  // The upper edge of the image is where the rotation takes the y axis not.
  if (upwards < 0)
    return directions_along(-2 * (q.x * q.y - q.w * q.z), 2 * (q.x * q.x + q.z * q.z) - 1);
  return directions_along(-viewer.position.x, -viewer.position.y);
}

GroundPoint as_seen(const GroundDirections& directions, const GroundPoint& point) {
  return {distance_to_side(directions, SpatialRelation::right, point, {}),
          distance_to_side(directions, SpatialRelation::back, point, {})};
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
