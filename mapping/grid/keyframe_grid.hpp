#pragma once

#include "castor/mapping/grid/occupancy_grid.hpp"

#include <cstddef>
#include <memory>
#include <set>
#include <string>
#include <unordered_map>

namespace castor::mapping {

/// An occupancy grid of keyframes, which is kept up to date when poses are corrected.
class KeyframeGrid {
public:
  /// Corrections below both limits leave the grid as it is, until they add up to more. By default
  /// half a cell, and the angle that moves a wall in 10 m by half a cell.
  struct Tolerance {
    double metres = 0.025;
    double radians = 0.0025;
  };

  explicit KeyframeGrid(OccupancyGridOptions options = {});
  KeyframeGrid(OccupancyGridOptions options, Tolerance tolerance)
    : grid_(options), tolerance_(tolerance) {}

  /// Adds a keyframe, or corrects its pose. The scan of a known keyframe is ignored.
  /// @returns the tiles that have changed
  std::set<TileIndex> place(const std::string& keyframe, std::shared_ptr<const LaserScan> scan,
                            const Pose2& robot);

  /// Takes a keyframe out; an unknown one is ignored.
  std::set<TileIndex> remove(const std::string& keyframe);

  bool has(const std::string& keyframe) const { return placed_.contains(keyframe); }

  std::size_t size() const { return placed_.size(); }

  const OccupancyGrid& grid() const { return grid_; }

private:
  struct Placed {
    std::shared_ptr<const LaserScan> scan;
    Pose2 robot;
  };

  bool is_within_tolerance(const Pose2& before, const Pose2& after) const;

  OccupancyGrid grid_;
  Tolerance tolerance_;
  std::unordered_map<std::string, Placed> placed_;
};

} // namespace castor::mapping
