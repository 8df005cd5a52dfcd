#include "castor/mapping/slam/map_frame.hpp"

#include "castor/mapping/geometry/poses.hpp"
#include "castor/mapping/planar/poses.hpp"

#include <cmath>

namespace castor::mapping {

PoseCovariance turned(const PoseCovariance& x, double heading) {
  auto c = std::cos(heading);
  auto s = std::sin(heading);
  PoseCovariance result;
  result.xx = c * c * x.xx - 2 * c * s * x.xy + s * s * x.yy;
  result.yy = s * s * x.xx + 2 * c * s * x.xy + c * c * x.yy;
  result.xy = c * s * (x.xx - x.yy) + (c * c - s * s) * x.xy;
  result.x_heading = c * x.x_heading - s * x.y_heading;
  result.y_heading = s * x.x_heading + c * x.y_heading;
  result.heading = x.heading;
  return result;
}

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

} // namespace castor::mapping
