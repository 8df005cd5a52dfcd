#pragma once

#include "castor/mapping/planar/types.hpp"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>

namespace castor::mapping {

/// The odometry of the last seconds, to know where the wheels had the robot when a scan was taken.
class OdometryHistory {
public:
  /// @param most how many are remembered
  explicit OdometryHistory(std::size_t most = 1000) : most_(most) {}

  /// The next; one that is not newer than the last is ignored.
  void add(const Odometry& x);

  /// Pose at that time, between the two around it; nothing before the first and after the last.
  std::optional<Pose2> pose_at(std::int64_t time) const;

  /// The newest; nothing before the first.
  std::optional<Odometry> newest() const;

private:
  std::size_t most_;
  std::deque<Odometry> known_;
};

} // namespace castor::mapping
