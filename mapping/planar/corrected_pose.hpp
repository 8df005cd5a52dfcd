#pragma once

#include "castor/mapping/planar/odometry_history.hpp"

#include <cstdint>
#include <optional>

namespace castor::mapping {

/// Pose of the robot now, from a pose that somebody found for a moment ago and from how it has
/// moved since then by its odometry.
class CorrectedPose {
public:
  /// The newest odometry; older than the newest so far is ignored.
  void add(const Odometry& x);

  /// Where the robot was at that time, in any frame. One from before the first odometry counts from
  /// that on, since poses are told again when the robot moves; one that is newer than odometry
  /// waits for it, and holds meanwhile if it is newer by half a second at most.
  /// @param time microseconds, as in Odometry
  void correct(std::int64_t time, const Pose2& pose);

  /// In the frame of the correction. Nothing without a correction, or without odometry of about its
  /// time.
  std::optional<Pose2> now() const;

  /// Pose of the odometry frame in the frame of the correction. Nothing as with `now()`.
  const std::optional<Pose2>& odometry_frame() const { return frame_; }

  const OdometryHistory& odometry() const { return history_; }

private:
  struct Correction {
    std::int64_t time = 0;
    Pose2 pose;
  };

  void place(Correction x);
  std::optional<Pose2> odometry_at(std::int64_t time) const;

  OdometryHistory history_;
  std::optional<Odometry> first_;
  /// Newer than odometry.
  std::optional<Correction> waiting_;
  std::optional<Pose2> frame_;
};

} // namespace castor::mapping
