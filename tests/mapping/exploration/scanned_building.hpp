#pragma once

#include "castor/mapping/building/building.hpp"
#include "castor/mapping/building/reachable_floor.hpp"
#include "castor/mapping/building/solid_obstacles.hpp"
#include "castor/mapping/building/solids.hpp"
#include "castor/mapping/grid/occupancy_grid.hpp"
#include "castor/mapping/planar/types.hpp"

#include <cmath>
#include <numbers>
#include <set>

namespace castor::mapping::test {

/// A building, and the grid of what an exact laser has seen of it.
class ScannedBuilding {
public:
  explicit ScannedBuilding(const Building& x)
    : obstacles_(between_heights(solids_of(x), 0.29, 0.31)), floor_(x) {
    // nop
  }

  /// 180 degrees ahead. Returns the tiles that have changed.
  std::set<TileIndex> scan(const Pose2& robot) {
    LaserScan result;
    constexpr int beams = 361;
    result.first_angle = -std::numbers::pi / 2;
    result.angle_step = std::numbers::pi / (beams - 1);
    result.max_range = 12;
    for (int i = 0; i < beams; ++i)
      result.ranges.push_back(static_cast<float>(
        obstacles_
          .cast({robot.x, robot.y}, robot.heading + result.first_angle + i * result.angle_step, 12)
          .value_or(0)));
    return grid_.insert(result, robot);
  }

  const OccupancyGrid& grid() const { return grid_; }

  const ReachableFloor& floor() const { return floor_; }

private:
  SolidObstacles obstacles_;
  ReachableFloor floor_;
  OccupancyGrid grid_;
};

} // namespace castor::mapping::test
