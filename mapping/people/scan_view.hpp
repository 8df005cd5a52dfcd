#pragma once

#include "castor/mapping/planar/poses.hpp"
#include "castor/mapping/planar/types.hpp"

namespace castor::mapping {

/// Tells what a scan says of a place: whether the laser could see something there, and does.
class ScanView {
public:
  /// @param scan has to live as long as this
  /// @param robot its pose when it was scanned
  ScanView(const LaserScan& scan, const Pose2& robot);

  /// Shares of the beams to a disc, 0 to 1; the rest ends in it.
  struct Shares {
    /// End before it, or look elsewhere: it may be hidden.
    double hidden = 0;
    /// End beyond it: it is not there.
    double passed = 0;
  };

  Shares towards(const Point2& place, double radius) const;

private:
  const LaserScan& scan_;
  Pose2 from_scanner_;
};

} // namespace castor::mapping
