#pragma once

#include "castor/mapping/planar/poses.hpp"

#include <cstddef>
#include <vector>

namespace castor::mapping {

/// A way whose headings matter: motions one after the other, each along an arc, straight on, or a
/// turn on the spot.
struct PosePath {
  Pose2 start;
  /// How far each goes forwards, metres, negative backwards, and by how much it turns, radians.
  std::vector<Twist2> motions;

  bool empty() const { return motions.empty(); }
};

/// Where a motion is at a share of it, 0 to 1.
Pose2 pose_on(const Pose2& begin, const Twist2& motion, double share);

/// Where the motions begin, one more for where the last one ends.
std::vector<Pose2> begins_of(const PosePath& path);

/// Way driven, forwards and backwards; metres.
double length(const PosePath& path);

/// Number of changes between forwards and backwards.
int gear_changes(const PosePath& path);

} // namespace castor::mapping
