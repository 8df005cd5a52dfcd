#include "castor/mapping/grid/tile_entries.hpp"

#include "castor/mapping/grid/tile_codec.hpp"

#include <string>
#include <utility>

namespace castor::mapping {

void TileEntries::adopt(const GridTile& tile) {
  written_[{tile.column, tile.row}] = {tile.version, tile.bytes};
}

std::vector<GridTile> TileEntries::changed(const OccupancyGrid& grid,
                                           const std::set<TileIndex>& touched) {
  std::vector<GridTile> result;
  for (auto& tile : touched) {
    auto bytes = encode_tile(grid.cells(tile));
    auto& written = written_[tile];
    if (written.bytes == bytes)
      continue;
    written = {written.version + 1, std::move(bytes)};
    result.push_back({tile.column, tile.row, written.version, grid.cell_size(), written.bytes});
  }
  return result;
}

std::set<TileIndex> TileEntries::tiles() const {
  std::set<TileIndex> result;
  for (auto& [tile, written] : written_)
    result.insert(result.end(), tile);
  return result;
}

std::string id_of(const TileIndex& tile) {
  return "tile " + std::to_string(tile.column) + ' ' + std::to_string(tile.row);
}

} // namespace castor::mapping
