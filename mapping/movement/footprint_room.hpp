#pragma once

#include "castor/mapping/body/footprint.hpp"
#include "castor/mapping/movement/clearance_map.hpp"
#include "castor/mapping/movement/pose_path.hpp"

#include <vector>

namespace castor::mapping {

/// How much room a footprint has on a map.
class FootprintRoom {
public:
  /// @param clearance is referred to
  /// @param margin to keep from obstacles, metres
  FootprintRoom(const ClearanceMap& clearance, const Footprint& footprint, double margin);

  /// How much farther than the margin the nearest obstacle is, metres; not more, and less where
  /// there is plenty. Not positive: the footprint does not fit there.
  double at(const Pose2& robot) const;

  /// Whether the footprint fits all along a motion, looked at where its outline has come on by
  /// `step`, metres, or by the room that it has.
  bool is_free(const Pose2& begin, const Twist2& motion, double step) const;
  bool is_free(const PosePath& path, double step) const;

private:
  const ClearanceMap& clearance_;
  double outer_radius_;
  /// To be kept from the samples, so that the margin is kept in between; metres.
  double kept_;
  /// Of the outline and of what is inside, in the robot's frame.
  std::vector<Point2> samples_;
};

} // namespace castor::mapping
