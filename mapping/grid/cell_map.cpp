#include "castor/mapping/grid/cell_map.hpp"

#include "castor/mapping/grid/occupancy_grid.hpp"
#include "castor/mapping/grid/tile_codec.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace castor::mapping {

namespace {

using DecodedTiles = std::vector<std::pair<TileIndex, TileCells>>;

Cell cell_at(const TileIndex& tile, std::size_t position) {
  auto first = first_cell(tile);
  return {first.column + static_cast<std::int32_t>(position % tile_side),
          first.row + static_cast<std::int32_t>(position / tile_side)};
}

CellMap assemble(const DecodedTiles& tiles, double cell_size) {
  constexpr auto none = std::numeric_limits<std::int32_t>::max();
  Cell low{none, none};
  Cell high{-none, -none};
  for (auto& [tile, cells] : tiles)
    for (std::size_t i = 0; i < cells.size(); ++i)
      if (cells[i] != unknown_cell) {
        auto cell = cell_at(tile, i);
        low = {std::min(low.column, cell.column), std::min(low.row, cell.row)};
        high = {std::max(high.column, cell.column), std::max(high.row, cell.row)};
      }
  CellMap result;
  result.cell_size = cell_size;
  if (low.column == none)
    return result;
  result.columns = high.column - low.column + 1;
  result.rows = high.row - low.row + 1;
  result.origin = {low.column * cell_size, low.row * cell_size, 0};
  result.cells.resize(
    static_cast<std::size_t>(result.columns) * static_cast<std::size_t>(result.rows), -1);
  for (auto& [tile, cells] : tiles)
    for (std::size_t i = 0; i < cells.size(); ++i)
      if (cells[i] != unknown_cell) {
        auto cell = cell_at(tile, i);
        result.at(cell.column - low.column, cell.row - low.row) =
          static_cast<std::int8_t>(std::lround(100 * probability(cells[i])));
      }
  return result;
}

} // namespace

CellMap cell_map(const OccupancyGrid& grid) {
  DecodedTiles tiles;
  for (auto& x : grid.tiles())
    tiles.emplace_back(x, grid.cells(x));
  return assemble(tiles, grid.cell_size());
}

CellMap cell_map(std::span<const GridTile> tiles) {
  DecodedTiles decoded;
  for (auto& x : tiles)
    if (x.cell_size == tiles.front().cell_size)
      decoded.emplace_back(TileIndex{x.column, x.row}, decode_tile(x.bytes));
  return assemble(decoded, tiles.empty() ? CellMap{}.cell_size : tiles.front().cell_size);
}

} // namespace castor::mapping
