#pragma once

#include "castor/mapping/grid/cell_map.hpp"
#include "castor/mapping/planar/poses.hpp"

#include <cstdint>
#include <vector>

namespace castor::mapping {

/// Where a disc can go from a start, by a method that shares nothing with plan_path(): free cells
/// are eroded by the disc (dilation of the obstacles, connected components). A check of the
/// planner's refusals.
class ReachableCells {
public:
  /// Obstacles are cells from `occupied_from` percent, unknown ones, and what is outside the map.
  /// @param clearance of the disc's middle from cells that are no floor, metres
  /// @param start_tolerance the disc may begin at the nearest place where it fits, so far away
  /// \pre the rows of the map are parallel to the x axis.
  ReachableCells(const CellMap& map, const Point2& start, double clearance,
                 double start_tolerance = 0.4, int occupied_from = 60);

  /// False outside the map.
  bool can_be_at(const Point2& p) const;

private:
  int columns_;
  int rows_;
  double cell_size_;
  Point2 origin_;
  std::vector<std::uint8_t> reachable_;
};

} // namespace castor::mapping
