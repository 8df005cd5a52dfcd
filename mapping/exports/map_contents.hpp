#pragma once

#include "castor/mapping/planar/types.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

/// What files of a map are made of, without its grid. Poses are in the frame of the map.
namespace castor::mapping {

struct ExportedKeyframe {
  /// Microseconds since the system began.
  std::int64_t time = 0;
  /// The robot, corrected.
  Pose2 pose;
  /// The robot by its odometry, in the odometry frame.
  Pose2 odometry;
  LaserScan scan;
};

/// A measurement of one keyframe's pose as seen from another one.
struct ExportedConstraint {
  /// Positions among the keyframes.
  std::size_t from = 0;
  std::size_t to = 0;
  Pose2 relative;
  /// Inverse of the covariance of x, y, heading: its upper triangle xx, xy, xh, yy, yh, hh.
  std::array<double, 6> information{1, 0, 0, 1, 0, 1};
};

struct MapContents {
  /// In the order of their times.
  std::vector<ExportedKeyframe> keyframes;
  std::vector<ExportedConstraint> constraints;
};

} // namespace castor::mapping
