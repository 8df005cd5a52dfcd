#include "castor/mapping/grid/cells.hpp"

#include <cmath>

namespace castor::mapping {

namespace {

// Shifts round towards minus infinity, unlike divisions.
constexpr int tile_bits = 6;
static_assert(1 << tile_bits == tile_side);

} // namespace

Cell cell_of(const Point2& point, double cell_size) {
  return {static_cast<std::int32_t>(std::floor(point.x / cell_size)),
          static_cast<std::int32_t>(std::floor(point.y / cell_size))};
}

Point2 centre_of(const Cell& cell, double cell_size) {
  return {(cell.column + 0.5) * cell_size, (cell.row + 0.5) * cell_size};
}

TileIndex tile_of(const Cell& cell) {
  return {cell.column >> tile_bits, cell.row >> tile_bits};
}

std::size_t position_in_tile(const Cell& cell) {
  constexpr auto mask = tile_side - 1;
  return static_cast<std::size_t>(cell.row & mask) * tile_side +
         static_cast<std::size_t>(cell.column & mask);
}

Cell first_cell(const TileIndex& tile) {
  return {tile.column * tile_side, tile.row * tile_side};
}

double probability(std::int8_t cell) {
  return cell == unknown_cell ? 0.5 : 1 / (1 + std::exp(-quantum * cell));
}

} // namespace castor::mapping
