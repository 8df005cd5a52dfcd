#pragma once

#include "castor/mapping/grid/cell_map.hpp"
#include "castor/mapping/planar/types.hpp"

#include <vector>

namespace castor::mapping {

struct MapFitOptions {
  /// A beam is explained if it ends so near to an occupied cell, m ...
  double near = 0.2;
  /// ... and passes none before that. A cell that is that near to the end does not count, since the
  /// pose is not exact.
  double before_end = 0.4;
  /// Cells of at least this probability are occupied, percent.
  int occupied_from = 65;
  /// How many beams of a scan are looked at, at most.
  std::size_t beams = 90;
};

/// Tells how much of a scan a map explains.
class MapFit {
public:
  explicit MapFit(const CellMap& map, const MapFitOptions& options = {});

  /// Share of the scan's beams that the map explains if the robot is there, from 0 to 1; 1 for a
  /// scan in which nothing came back.
  double explained(const LaserScan& scan, const Pose2& robot) const;

  /// Area of the free cells, m2.
  double free_area() const { return free_area_; }

private:
  /// Metres from the point to the nearest occupied cell; large outside of the map.
  float distance_at(double x, double y) const;
  bool is_explained(const Pose2& scanner, double angle, double range) const;

  MapFitOptions options_;
  int columns_;
  int rows_;
  double cell_;
  Pose2 origin_;
  double free_area_ = 0;
  /// Of each cell from the nearest occupied one, m.
  std::vector<float> distances_;
};

} // namespace castor::mapping
