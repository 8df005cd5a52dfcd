#pragma once

#include "castor/base/diagnostic.hpp"
#include "castor/mapping/planar/types.hpp"

#include <cstdint>
#include <optional>
#include <vector>

namespace castor::mapping {

/// A scan with where the wheels said that the robot was.
struct LoggedScan {
  LaserScan scan;
  Odometry odometry;
  /// As the log has it; by it, others refer to the scan. The scan's own time is never later.
  std::int64_t logged_time = 0;

  friend bool operator==(const LoggedScan&, const LoggedScan&) = default;
};

/// What a robot recorded on the way. Times are microseconds by the log's own clock.
struct RobotLog {
  /// In the order in which they were measured.
  std::vector<LoggedScan> scans;
  /// Odometry beside that of the scans, in order of time; may be empty.
  std::vector<Odometry> odometry;
};

struct RobotLogResult {
  /// Nothing if there are errors.
  std::optional<RobotLog> log;
  std::vector<Diagnostic> diagnostics;
};

} // namespace castor::mapping
