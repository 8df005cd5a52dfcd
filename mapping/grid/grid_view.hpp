#pragma once

#include "castor/mapping/grid/cell_map.hpp"
#include "castor/mapping/grid/cells.hpp"
#include "castor/mapping/grid/types.hpp"

#include <cstdint>
#include <map>
#include <optional>

namespace castor::mapping {

/// A rectangle of cells of the grid; `high` is one beyond the last column and row.
struct CellRegion {
  Cell low;
  Cell high;

  /// The smallest region that holds both.
  CellRegion united(const CellRegion& other) const;

  friend bool operator==(const CellRegion&, const CellRegion&) = default;
};

/// The grid in one piece, kept up to date from its tile entries. It grows by whole tiles and never
/// shrinks. An update costs one tile, unless the map has to grow.
class GridView {
public:
  /// A tile was added or overwritten.
  /// @returns the smallest region that holds all changed cells, or nothing if no cell changed; one
  /// of a version older than the known one, or of another cell size than the first tile, is ignored
  /// @throws DamagedTile
  std::optional<CellRegion> apply(const GridTile& tile);

  /// A tile was deleted: its cells become unknown.
  std::optional<CellRegion> remove(const TileIndex& tile);

  /// Has columns and rows as many as the tiles that were ever known span. Empty without a tile.
  const CellMap& map() const { return map_; }

  /// The cell of the grid that is cell (0, 0) of the map.
  Cell first() const { return first_; }

  /// Number of changes so far.
  std::uint64_t version() const { return version_; }

private:
  void grow_to_hold(const TileIndex& tile);
  std::optional<CellRegion> set_cells(const TileIndex& tile, const TileCells& cells);

  CellMap map_;
  Cell first_;
  std::map<TileIndex, std::uint64_t> tile_versions_;
  std::uint64_t version_ = 0;
};

} // namespace castor::mapping
