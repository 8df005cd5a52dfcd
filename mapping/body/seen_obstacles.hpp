#pragma once

#include "castor/mapping/grid/cells.hpp"
#include "castor/mapping/planar/poses.hpp"

#include <cstdint>
#include <map>
#include <span>
#include <vector>

namespace castor::mapping {

struct SeenObstaclesOptions {
  /// Side of the cells that it remembers, metres.
  double cell_size = 0.05;
  /// Ranges beyond are ignored, metres.
  double reach = 4;
  /// Something that no beam has shown again is remembered so long, microseconds.
  std::int64_t memory = 3'000'000;
  /// A beam that goes so far beyond a remembered place shows that it is free, metres.
  double beyond = 0.15;
};

/// What a laser has seen lately: a robot with a laser in front remembers what is beside it, and
/// forgets people who have gone on.
class SeenObstacles {
public:
  explicit SeenObstacles(const SeenObstaclesOptions& options = {}) : options_(options) {}

  /// @param robot where it was when it measured the scan, in the map frame
  void add(const LaserScan& scan, const Pose2& robot);

  /// In the map frame, at most one for a cell.
  std::vector<Point2> points() const;

private:
  void forget(const LaserScan& scan, const Pose2& robot);

  struct Seen {
    Point2 point;
    std::int64_t time = 0;
  };

  SeenObstaclesOptions options_;
  std::map<Cell, Seen> seen_;
};

} // namespace castor::mapping
