#pragma once

#include "castor/mapping/planar/poses.hpp"

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>

namespace castor::mapping {

/// Cells on a side of a tile.
inline constexpr int tile_side = 64;

/// A cell of a grid: cell (0, 0) has its lower left corner at the origin of the frame.
struct Cell {
  std::int32_t column = 0;
  std::int32_t row = 0;

  friend auto operator<=>(const Cell&, const Cell&) = default;
};

/// A tile of a grid, counted as in GridTile.
struct TileIndex {
  std::int32_t column = 0;
  std::int32_t row = 0;

  friend auto operator<=>(const TileIndex&, const TileIndex&) = default;
};

/// Cells of a tile as log-odds of being occupied, in units of `quantum`, row by row from below.
using TileCells = std::array<std::int8_t, std::size_t{tile_side} * tile_side>;

/// Unit of quantised log-odds.
inline constexpr double quantum = 0.05;
/// Value of a cell that no scan has seen.
inline constexpr std::int8_t unknown_cell = -128;

/// The cell that holds a point. The cell size is in metres.
Cell cell_of(const Point2& point, double cell_size);

/// Centre of a cell.
Point2 centre_of(const Cell& cell, double cell_size);

TileIndex tile_of(const Cell& cell);

/// Position of a cell within TileCells of its tile.
std::size_t position_in_tile(const Cell& cell);

/// The lower left cell of a tile.
Cell first_cell(const TileIndex& tile);

/// Probability that the cell is occupied; 0.5 for `unknown_cell`.
double probability(std::int8_t cell);

} // namespace castor::mapping

template <>
struct std::hash<castor::mapping::TileIndex> {
  std::size_t operator()(const castor::mapping::TileIndex& x) const noexcept {
    auto both = (std::uint64_t{static_cast<std::uint32_t>(x.column)} << 32) |
                static_cast<std::uint32_t>(x.row);
    return std::hash<std::uint64_t>{}(both * 0x9E3779B97F4A7C15U);
  }
};
