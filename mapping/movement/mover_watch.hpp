#pragma once

#include "castor/mapping/movement/movers.hpp"
#include "castor/mapping/people/person_detector.hpp"
#include "castor/mapping/people/person_tracks.hpp"
#include "castor/mapping/planar/odometry_history.hpp"

#include <vector>

namespace castor::mapping {

/// Sees in the scans of a robot who walks near it. It needs no map, and no other component.
class MoverWatch {
public:
  MoverWatch();

  void add(const Odometry& x) { odometry_.add(x); }
  /// A scan from before the first odometry is ignored.
  void add(const LaserScan& scan);

  /// In the frame in which the robot is there now; those who have stopped lately, too.
  std::vector<Mover> movers(const Pose2& robot) const;

private:
  OdometryHistory odometry_;
  PersonDetector detector_;
  PersonTracks tracks_;
};

} // namespace castor::mapping
