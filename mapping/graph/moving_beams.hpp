#pragma once

#include "castor/mapping/planar/types.hpp"
#include "castor/mapping/planar/view.hpp"

#include <cstdint>
#include <deque>
#include <memory>
#include <vector>

namespace castor::mapping {

struct MovingBeamsOptions {
  /// Scans of this time before count, microseconds; CAST's Explorer has some two seconds.
  std::int64_t memory = 2'000'000;
  /// A place was free if a beam went on behind it by more than this, metres.
  double behind = 0.3;
  /// Number of scans in which it was.
  int scans = 2;
};

/// Finds beams that hit something that moves, such as people: where they end, scans shortly before
/// have seen that there was nothing.
class MovingBeams {
public:
  using ScanPtr = std::shared_ptr<const LaserScan>;

  explicit MovingBeams(const MovingBeamsOptions& options = {}) : options_(options) {}

  /// For each beam of the scan, whether it hit something that moves. To be called in the order of
  /// time.
  /// @param robot pose at the scan, without jumps from one scan to the next
  std::vector<bool> add(const ScanPtr& scan, const Pose2& robot);

private:
  MovingBeamsOptions options_;
  std::deque<View> seen_;
};

} // namespace castor::mapping
