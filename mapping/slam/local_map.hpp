#pragma once

#include "castor/mapping/slam/placed_scan.hpp"
#include "castor/mapping/slam/point_map.hpp"
#include "castor/mapping/slam/surface_points.hpp"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>

namespace castor::mapping {

struct LocalMapOptions {
  /// Number of keyframes: the newest.
  std::size_t keyframes = 15;
  /// Scans since then count for what has moved, each after so long, us; and for so long.
  std::int64_t look_period = 250'000;
  std::int64_t look_memory = 3'000'000;
  MovedOptions moved;
};

/// What stands around a robot: surface points of its newest keyframes, without what has moved. In
/// one frame.
class LocalMap {
public:
  explicit LocalMap(const LocalMapOptions& options = {}) : options_(options) {}

  void clear() { *this = LocalMap{options_}; }

  /// A keyframe.
  void place(std::shared_ptr<const LaserScan> scan, const Pose2& robot,
             const SurfacePoints& on_robot);

  /// A scan that is no keyframe.
  void look(const LaserScan& scan, const Pose2& robot);

  /// The points of a scan without those where nothing stood.
  SurfacePoints standing(const SurfacePoints& on_robot, const Pose2& robot) const;

  const PointMap& points() const { return points_; }

private:
  bool stood(const Point2& point) const;
  void gather();

  LocalMapOptions options_;
  std::deque<PlacedScan> keyframes_;
  std::deque<View> looks_;
  PointMap points_;
};

} // namespace castor::mapping
