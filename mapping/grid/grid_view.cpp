#include "castor/mapping/grid/grid_view.hpp"

#include "castor/mapping/grid/tile_codec.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace castor::mapping {

namespace {

std::int8_t percent(std::int8_t cell) {
  if (cell == unknown_cell)
    return -1;
  return static_cast<std::int8_t>(std::lround(100 * probability(cell)));
}

} // namespace

CellRegion CellRegion::united(const CellRegion& other) const {
  return {{std::min(low.column, other.low.column), std::min(low.row, other.low.row)},
          {std::max(high.column, other.high.column), std::max(high.row, other.high.row)}};
}

std::optional<CellRegion> GridView::apply(const GridTile& tile) {
  const TileIndex index{tile.column, tile.row};
  const auto known = tile_versions_.find(index);
  if (known != tile_versions_.end() && tile.version <= known->second)
    return std::nullopt;
  if (map_.columns > 0 && tile.cell_size != map_.cell_size)
    return std::nullopt;
  const auto cells = decode_tile(tile.bytes);
  map_.cell_size = tile.cell_size;
  tile_versions_[index] = tile.version;
  grow_to_hold(index);
  return set_cells(index, cells);
}

std::optional<CellRegion> GridView::remove(const TileIndex& tile) {
  if (tile_versions_.erase(tile) == 0)
    return std::nullopt;
  TileCells cells;
  cells.fill(unknown_cell);
  return set_cells(tile, cells);
}

void GridView::grow_to_hold(const TileIndex& tile) {
  const auto low = first_cell(tile);
  const Cell high{low.column + tile_side, low.row + tile_side};
  CellRegion all{low, high};
  const CellRegion now{first_, {first_.column + map_.columns, first_.row + map_.rows}};
  if (map_.columns > 0)
    all = all.united(now);
  if (map_.columns > 0 && all == now)
    return;
  CellMap grown;
  grown.columns = all.high.column - all.low.column;
  grown.rows = all.high.row - all.low.row;
  grown.cell_size = map_.cell_size;
  grown.origin = {all.low.column * map_.cell_size, all.low.row * map_.cell_size, 0};
  grown.cells.assign(static_cast<std::size_t>(grown.columns) * static_cast<std::size_t>(grown.rows),
                     -1);
  for (int row = 0; row < map_.rows; ++row)
    for (int column = 0; column < map_.columns; ++column)
      grown.at(column + first_.column - all.low.column, row + first_.row - all.low.row) =
        map_.at(column, row);
  map_ = std::move(grown);
  first_ = all.low;
}

std::optional<CellRegion> GridView::set_cells(const TileIndex& tile, const TileCells& cells) {
  const auto low = first_cell(tile);
  std::optional<CellRegion> changed;
  for (int row = 0; row < tile_side; ++row)
    for (int column = 0; column < tile_side; ++column) {
      const Cell cell{low.column + column, low.row + row};
      const auto value = percent(cells[position_in_tile(cell)]);
      auto& known = map_.at(cell.column - first_.column, cell.row - first_.row);
      if (known == value)
        continue;
      known = value;
      const CellRegion one{cell, {cell.column + 1, cell.row + 1}};
      changed = changed ? changed->united(one) : one;
    }
  if (changed)
    ++version_;
  return changed;
}

} // namespace castor::mapping
