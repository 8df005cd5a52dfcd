#pragma once

#include "castor/mapping/planar/poses.hpp"
#include "castor/mapping/planar/types.hpp"

#include <memory>

namespace castor::mapping {

/// A scan, and where it was taken: it tells where nothing stood.
class View {
public:
  /// @param robot its pose at the scan
  View(std::shared_ptr<const LaserScan> scan, const Pose2& robot);

  const LaserScan& scan() const { return *scan_; }

  /// Whether the beam towards a point, in the frame of the pose, and those beside it, end
  /// more than `behind` metres behind it. Where nothing came back, nothing is known.
  bool passes(const Point2& point, double behind) const;

private:
  std::shared_ptr<const LaserScan> scan_;
  Pose2 scanner_;
  double cosine_ = 1;
  double sine_ = 0;
};

} // namespace castor::mapping
