#pragma once

#include "castor/mapping/geometry/types.hpp"
#include "castor/mapping/planar/types.hpp"

#include <cstdint>

namespace castor::mapping {

/// The frame of the odometry in that of the map, if the robot is there in the map and has this
/// odometry.
geometry::Transform odometry_in_map(const Pose2& in_map, const Pose2& odometry, std::int64_t time);

/// Where such a frame is on the floor of the map, the inverse of `odometry_in_map`.
Pose2 floor_pose(const geometry::Transform& frame);

} // namespace castor::mapping
