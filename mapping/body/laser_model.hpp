#pragma once

#include "castor/mapping/body/noise.hpp"
#include "castor/mapping/building/obstacles.hpp"
#include "castor/mapping/planar/types.hpp"

#include <cstdint>
#include <span>

namespace castor::mapping {

struct LaserOptions {
  /// Whole degrees from the first to the last beam's direction: 180 has 181 beams, 360 as many as
  /// fit without one twice.
  int field_of_view = 180;
  /// Beams per degree.
  int beams_per_degree = 1;
  /// Metres; nothing comes back from beyond.
  double max_range = 12;
  /// Standard deviation of a range, metres.
  double range_noise = 0.01;
  /// Probability that nothing comes back.
  double missing = 0.003;
  /// The scanner on the robot.
  Pose2 mount{0.1, 0, 0};
};

/// A laser scanner that measures all its beams at one time.
class LaserModel {
public:
  /// \throws std::invalid_argument unless the field of view is in [1, 360], and the numbers of
  /// beams and the ranges are positive.
  LaserModel(const LaserOptions& options, std::uint64_t seed);

  /// @param robot its true pose
  /// @param time microseconds, of the scan
  LaserScan scan(const Obstacles& fixed, std::span<const Disc> moving, const Pose2& robot,
                 std::int64_t time);

private:
  LaserOptions options_;
  Noise noise_;
};

} // namespace castor::mapping
