#pragma once

#include "castor/mapping/grid/cells.hpp"
#include "castor/mapping/grid/scan_cells.hpp"

#include <array>
#include <cstdint>
#include <set>
#include <unordered_map>
#include <vector>

namespace castor::mapping {

struct OccupancyGridOptions {
  ScanCellsOptions cells;
  // Log-odds: the update of a cell that a beam ends in, or passes, and the limits of what is
  // reported. The values are those of OctoMap (A. Hornung et al., 2013): probabilities 0.7, 0.4,
  // 0.97 and 0.12.
  double hit = 0.85;
  double pass = -0.4;
  double most = 3.5;
  double least = -2;
};

/// An occupancy grid in tiles, whose scans can be taken out again.
///
/// A cell counts the scans that hit it and that passed it; log-odds are calculated from the counts.
/// So a scan whose pose was corrected is removed exactly, whatever came after it, and the order of
/// scans does not matter. That is why MRPT's COccupancyGridMap2D is not used here, although it
/// takes a tenth of the time for a scan: it keeps log-odds of 8 bits, with limits, so that an
/// update cannot be undone, and one piece that is copied as a whole when the map grows. It also
/// widens beams, so that walls are two cells thick, and not one. tests/mapping/grid compares both
/// on the same scans.
class OccupancyGrid {
public:
  /// @throws std::invalid_argument if the cell size is not positive, or log-odds have the wrong
  /// sign or exceed 100 quanta
  explicit OccupancyGrid(OccupancyGridOptions options = {});

  /// Adds the evidence of a scan that was taken with the robot at `robot`.
  /// @returns the tiles with a cell that the scan has evidence about
  std::set<TileIndex> insert(const LaserScan& scan, const Pose2& robot);

  /// Takes out a scan that was inserted at exactly this pose.
  std::set<TileIndex> remove(const LaserScan& scan, const Pose2& robot);

  /// Quantised log-odds of a cell, or `unknown_cell`.
  std::int8_t at(const Cell& cell) const;

  /// Tiles with evidence, or that had it once, sorted.
  std::vector<TileIndex> tiles() const;

  /// All cells of a tile.
  TileCells cells(const TileIndex& tile) const;

  double cell_size() const { return options_.cells.cell_size; }

  const OccupancyGridOptions& options() const { return options_; }

private:
  struct Counts {
    std::uint16_t hits = 0;
    std::uint16_t passes = 0;
  };
  using Tile = std::array<Counts, std::size_t{tile_side} * tile_side>;

  std::set<TileIndex> update(const ScanCells& cells, int change);
  std::int8_t value(const Counts& counts) const;

  OccupancyGridOptions options_;
  std::unordered_map<TileIndex, Tile> tiles_;
};

} // namespace castor::mapping
