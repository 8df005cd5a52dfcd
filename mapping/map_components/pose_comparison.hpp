#pragma once

#include "castor/mapping/map_components/types.hpp"
#include "castor/mapping/planar/odometry_history.hpp"
#include "castor/mapping/slam/types.hpp"

#include <cstdint>
#include <deque>
#include <vector>

namespace castor::mapping {

/// What localisation says beside the true poses, which only a simulator knows. Both are in one
/// frame.
class PoseComparison {
public:
  /// Where the robot truly was, in the order of time.
  void add_truth(std::int64_t time, const Pose2& pose);

  /// What was said of it, in the order of time; compared once the truth of that time is known.
  void add_pose(const RobotPose& x);

  PoseError error() const;

private:
  void compare_waiting();

  OdometryHistory truths_;
  std::deque<RobotPose> waiting_;
  std::vector<double> distances_;
  std::vector<double> turns_;
  PoseError error_;
  LocalisationState state_ = LocalisationState::starting;
};

} // namespace castor::mapping
