#pragma once

#include "castor/mapping/grid/occupancy_grid.hpp"
#include "castor/mapping/grid/types.hpp"

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace castor::mapping {

/// What the tile entries of a grid have been so far, to tell which of them to write.
class TileEntries {
public:
  /// An entry that is there already, as after a restart.
  void adopt(const GridTile& tile);

  /// The entries to write now that these tiles may have changed: a tile whose cells are what was
  /// written last is left out, as one whose cells were at their limits already.
  std::vector<GridTile> changed(const OccupancyGrid& grid, const std::set<TileIndex>& touched);

  bool has(const TileIndex& tile) const { return written_.contains(tile); }

  /// Tiles of all entries.
  std::set<TileIndex> tiles() const;

private:
  struct Written {
    std::uint64_t version = 0;
    std::vector<std::uint8_t> bytes;
  };

  std::map<TileIndex, Written> written_;
};

/// Id of a tile's entry: "tile 3 -2".
std::string id_of(const TileIndex& tile);

} // namespace castor::mapping
