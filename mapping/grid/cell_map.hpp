#pragma once

#include "castor/mapping/grid/cells.hpp"
#include "castor/mapping/grid/types.hpp"
#include "castor/mapping/planar/types.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace castor::mapping {

class OccupancyGrid;

/// A rectangle of cells in one piece, as map files have it.
struct CellMap {
  int columns = 0;
  int rows = 0;
  /// Side of a cell, metres.
  double cell_size = 0.05;
  /// Lower left corner of the lower left cell, and the direction of the rows, in the frame of the
  /// map.
  Pose2 origin;
  /// Probability that a cell is occupied, percent, or -1 where it is unknown; row by row from below
  /// (as in ROS's nav_msgs/OccupancyGrid).
  std::vector<std::int8_t> cells;

  std::int8_t& at(int column, int row) { return cells[position(column, row)]; }
  std::int8_t at(int column, int row) const { return cells[position(column, row)]; }

  friend bool operator==(const CellMap&, const CellMap&) = default;

private:
  std::size_t position(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
           static_cast<std::size_t>(column);
  }
};

/// The smallest map that holds all known cells of the grid; empty if there are none.
CellMap cell_map(const OccupancyGrid& grid);

/// The same from tile entries; those of a cell size other than the first one's are left out.
/// @throws DamagedTile
CellMap cell_map(std::span<const GridTile> tiles);

} // namespace castor::mapping
