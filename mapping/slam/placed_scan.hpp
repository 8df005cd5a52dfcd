#pragma once

#include "castor/mapping/planar/view.hpp"
#include "castor/mapping/slam/surface_points.hpp"

#include <cstdint>
#include <memory>
#include <vector>

namespace castor::mapping {

/// How what has moved, such as people, is told from what stands.
struct MovedOptions {
  /// Other scans have seen through a point that has moved: their beams end so far behind it, m ...
  double behind = 0.3;
  /// ... in at least so many of them.
  int scans = 2;
};

/// A scan's surface points in one frame with other scans, before it or after it, which tell what of
/// it has moved.
class PlacedScan {
public:
  PlacedScan(std::shared_ptr<const LaserScan> scan, const Pose2& robot,
             const SurfacePoints& on_robot, const MovedOptions& options);

  const View& view() const { return view_; }

  /// @returns whether it is known of more points now that they have moved
  bool learn_from(const View& other);

  /// Points of what stands, as far as is known, in the frame of all.
  SurfacePoints standing() const;

  /// Whether each point, in the order of the scan's, has moved.
  std::vector<bool> moved() const;

private:
  MovedOptions options_;
  View view_;
  SurfacePoints points_;
  /// For each point, how many scans have seen through it.
  std::vector<int> seen_through_;
};

} // namespace castor::mapping
