#pragma once

#include "castor/mapping/planar/odometry_history.hpp"
#include "castor/mapping/planar/types.hpp"

#include <cstddef>
#include <deque>
#include <memory>
#include <optional>

namespace castor::mapping {

/// Scans of a robot that wait until the odometry of their time is known.
class ScanQueue {
public:
  struct Ready {
    std::shared_ptr<const LaserScan> scan;
    /// Pose by odometry at the time of the scan.
    Pose2 odometry;
  };

  /// @param most how many wait; the oldest are dropped, for a robot whose odometry has stopped
  explicit ScanQueue(std::size_t most = 100) : most_(most) {}

  void add(const Odometry& x) { history_.add(x); }
  void add(std::shared_ptr<const LaserScan> x);

  /// Takes the oldest scan if the odometry of its time is known. Scans that are older than all
  /// odometry are dropped: nobody knows where they were taken.
  std::optional<Ready> next();

  std::optional<Odometry> newest_odometry() const { return history_.newest(); }

  /// No scan waits.
  bool empty() const { return waiting_.empty(); }

private:
  std::size_t most_;
  OdometryHistory history_;
  std::deque<std::shared_ptr<const LaserScan>> waiting_;
};

} // namespace castor::mapping
