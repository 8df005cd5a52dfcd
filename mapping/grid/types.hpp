#pragma once

#include "castor/wm/values/reflect.hpp"

#include <cstdint>
#include <vector>

/// The occupancy grid on working memory: square tiles, each an entry of its own, so that a scan
/// rewrites only the tiles that it touches.
namespace castor::mapping {

/// Entry: a square of `tile_side` x `tile_side` cells of the occupancy grid. One entry for each
/// tile that a scan has touched. The frame is that of the poses which the scans were inserted at.
struct GridTile {
  /// Tile (0, 0) has its lower left corner at the origin of the frame; columns count along x, rows
  /// along y, both may be negative.
  std::int32_t column = 0;
  std::int32_t row = 0;
  /// Number of modifications of the cells, from 1.
  std::uint64_t version = 0;
  /// Side of a cell, metres.
  double cell_size = 0;
  /// The cells, see encode_tile() and decode_tile().
  std::vector<std::uint8_t> bytes;

  friend bool operator==(const GridTile&, const GridTile&) = default;
};

CASTOR_REFLECT(GridTile, column, row, version, cell_size, bytes)

} // namespace castor::mapping
