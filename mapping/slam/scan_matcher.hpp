#pragma once

#include "castor/mapping/slam/point_map.hpp"
#include "castor/mapping/slam/types.hpp"

#include <cstddef>
#include <optional>

namespace castor::mapping {

struct ScanMatcherOptions {
  int max_iterations = 30;
  /// Points up to this distance belong together at first, m ...
  double first_distance = 0.4;
  /// ... and in the end; it shrinks by `shrinking` in each iteration.
  double last_distance = 0.12;
  double shrinking = 0.8;
  /// Deviation of a matched point from its line, m.
  double noise = 0.02;
  /// Deviations beyond this count less (Huber's loss), m.
  double robust_from = 0.03;
};

/// What is known of the pose before matching: deviations along and across, m, and of the heading.
struct PosePrior {
  double translation = 1;
  double heading = 1;
};

struct ScanMatch {
  /// Of the robot, in the frame of the map.
  Pose2 pose;
  /// Along the axes of that frame, by the noise of the points; without the prior.
  PoseCovariance covariance;
  /// How many of the scan's points with a normal are on a surface of the map, from 0 to 1.
  double matched = 0;
  /// Root mean square of distances of matched points from their lines, m.
  double deviation = 0;
  /// How well the direction that is known least is seen: the share of points that would notice
  /// movement in it, from 0 in an endless corridor to 0.5 in a round room.
  double observability = 0;
};

/// Aligns a scan with points of a map.
class PointMatcher {
public:
  virtual ~PointMatcher() = default;

  /// @param scan points on the robot
  /// @param guess where the search begins
  /// @param prior how well the guess is known already
  /// Without a match the pose is the guess and `matched` is 0.
  virtual ScanMatch match(const PointMap& map, const SurfacePoints& scan, const Pose2& guess,
                          const std::optional<PosePrior>& prior) const = 0;
};

/// The point-to-line metric: iterated closest points with the point-to-line metric
/// (Censi, "An ICP variant using a point-to-line metric", 2008), Gauss-Newton.
class ScanMatcher final : public PointMatcher {
public:
  explicit ScanMatcher(const ScanMatcherOptions& options = {}) : options_(options) {}

  /// The prior counts like other measurements.
  ScanMatch match(const PointMap& map, const SurfacePoints& scan, const Pose2& guess,
                  const std::optional<PosePrior>& prior = {}) const override;

private:
  ScanMatcherOptions options_;
};

} // namespace castor::mapping
