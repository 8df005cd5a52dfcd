#include "castor/mapping/planar/odometry_frame.hpp"

#include "castor/mapping/geometry/poses.hpp"
#include "castor/mapping/planar/poses.hpp"

#include <cmath>

namespace castor::mapping {

geometry::Transform odometry_in_map(const Pose2& in_map, const Pose2& odometry, std::int64_t time) {
  auto frame = compose(in_map, inverse(odometry));
  geometry::Transform result;
  result.frame = geometry::odometry_frame;
  result.pose.position = {frame.x, frame.y, 0};
  result.pose.rotation = geometry::rotation_about_z(frame.heading);
  result.pose.frame = geometry::map_frame;
  result.time = time;
  return result;
}

Pose2 floor_pose(const geometry::Transform& frame) {
  const auto& x = frame.pose;
  return {x.position.x, x.position.y, 2 * std::atan2(x.rotation.z, x.rotation.w)};
}

} // namespace castor::mapping
