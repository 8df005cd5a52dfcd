#pragma once

#include "castor/mapping/planar/types.hpp"
#include "castor/mapping/slam/types.hpp"

#include <cstdint>
#include <optional>

namespace castor::mapping {

struct PoseNewsOptions {
  /// Shortest time from one pose to the next in the same state, microseconds.
  std::int64_t period = 100'000;
  /// The robot stands while its wheels have moved it less than this, m and radians.
  double rest = 0.001;
  double rest_heading = 0.001;
  /// What a scan may say otherwise than the last pose while the robot stands, m and radians: more
  /// than its noise.
  double tolerance = 0.015;
  double tolerance_heading = 0.01;
};

/// Decides when the pose of a robot is told again. Others carry the last one on by odometry, so it
/// is no news while that explains the pose; but while the wheels turn, their errors grow, and each
/// pose is. So nothing is told of a robot that stands. Without threads and clocks.
class PoseNews {
public:
  explicit PoseNews(const PoseNewsOptions& options = {}) : options_(options) {}

  /// Whether it has to be told: it is the first, in another state or for another reason; or a
  /// period has passed since the last one, and the wheels have turned since, or it is not where
  /// they say.
  /// @param odometry of the time of the pose
  bool is_news(const RobotPose& x, const Pose2& odometry) const;

  /// It was told.
  void told(const RobotPose& x, const Pose2& odometry) { last_ = Told{x, odometry}; }

private:
  struct Told {
    RobotPose pose;
    Pose2 odometry;
  };

  PoseNewsOptions options_;
  std::optional<Told> last_;
};

} // namespace castor::mapping
