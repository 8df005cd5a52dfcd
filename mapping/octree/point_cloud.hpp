#pragma once

#include "castor/mapping/geometry/types.hpp"
#include "castor/mapping/planar/types.hpp"

#include <span>
#include <vector>

namespace castor::mapping {

/// Points that a sensor saw from one place, in the frame of the map.
struct PointCloud {
  geometry::Point3 sensor;
  std::vector<geometry::Point3> points;
};

/// The ends of the beams that came back, at the height of the scanner above the floor (metres).
PointCloud cloud_of(const LaserScan& scan, const Pose2& robot, double scanner_height);

/// The points of a depth image in rows from the top: metres along the optical axis of the camera, 0
/// or not finite where nothing was measured. The points are in the frame of the camera's pose.
/// @param step 2 takes each second pixel of each second row
/// @throws std::invalid_argument if there are not width * height depths, or the step is below 1
PointCloud cloud_of(std::span<const float> depths, const geometry::Camera& camera, int step = 1);

} // namespace castor::mapping
