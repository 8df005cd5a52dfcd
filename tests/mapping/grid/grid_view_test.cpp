#include "castor/mapping/grid/grid_view.hpp"

#include "castor/mapping/grid/occupancy_grid.hpp"
#include "castor/mapping/grid/tile_codec.hpp"
#include "castor/mapping/grid/tile_entries.hpp"
#include "castor/tests/mapping/grid/box_room.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <optional>

namespace castor::mapping {

namespace {

TileCells unknown_cells() {
  TileCells result;
  result.fill(unknown_cell);
  return result;
}

GridTile tile(TileIndex index, std::uint64_t version, const TileCells& cells) {
  return {index.column, index.row, version, 0.1, encode_tile(cells)};
}

TEST(GridView, HoldsWhatTheTilesSay) {
  const test::BoxRoom room{-2.02, 3.02, -1.52, 2.52};
  OccupancyGrid grid;
  TileEntries entries;
  GridView view;
  for (const Pose2 pose : {Pose2{0, 0, 0}, Pose2{0.5, 0.2, 0.4}, Pose2{1, 0.5, 1}}) {
    for (auto& x : entries.changed(grid, grid.insert(room.scan(pose, 360), pose)))
      view.apply(x);
    const auto expected = cell_map(grid);
    const int columns =
      static_cast<int>(std::lround((expected.origin.x - view.map().origin.x) / expected.cell_size));
    const int rows =
      static_cast<int>(std::lround((expected.origin.y - view.map().origin.y) / expected.cell_size));
    for (int row = 0; row < view.map().rows; ++row)
      for (int column = 0; column < view.map().columns; ++column) {
        const int c = column - columns;
        const int r = row - rows;
        const bool is_inside = c >= 0 && r >= 0 && c < expected.columns && r < expected.rows;
        ASSERT_EQ(view.map().at(column, row), is_inside ? expected.at(c, r) : -1)
          << column << ' ' << row;
      }
  }
}

TEST(GridView, TellsTheSmallestChangedRegion) {
  GridView view;
  auto cells = unknown_cells();
  cells[position_in_tile({3, 4})] = 20;
  cells[position_in_tile({6, 5})] = -20;
  EXPECT_EQ(view.apply(tile({-1, 0}, 1, cells)), (CellRegion{{-61, 4}, {-57, 6}}));
  EXPECT_EQ(view.first(), (Cell{-64, 0}));
  cells[position_in_tile({6, 5})] = -30;
  EXPECT_EQ(view.apply(tile({-1, 0}, 2, cells)), (CellRegion{{-58, 5}, {-57, 6}}));
  EXPECT_EQ(view.version(), 2u);
  EXPECT_EQ(view.apply(tile({-1, 0}, 3, cells)), std::nullopt);
  EXPECT_EQ(view.version(), 2u);
}

TEST(GridView, KeepsItsCellsWhenItGrows) {
  GridView view;
  auto cells = unknown_cells();
  cells[position_in_tile({3, 4})] = 60;
  view.apply(tile({0, 0}, 1, cells));
  const auto value = view.map().at(3, 4);
  view.apply(tile({-2, -1}, 1, unknown_cells()));
  EXPECT_EQ(view.map().columns, 3 * tile_side);
  EXPECT_EQ(view.map().rows, 2 * tile_side);
  EXPECT_EQ(view.map().at(3 + 2 * tile_side, 4 + tile_side), value);
  EXPECT_DOUBLE_EQ(view.map().origin.x, -12.8);
  EXPECT_DOUBLE_EQ(view.map().origin.y, -6.4);
}

TEST(GridView, ForgetsADeletedTile) {
  GridView view;
  auto cells = unknown_cells();
  cells[position_in_tile({3, 4})] = 60;
  view.apply(tile({0, 0}, 7, cells));
  EXPECT_EQ(view.remove({0, 0}), (CellRegion{{3, 4}, {4, 5}}));
  EXPECT_EQ(view.map().at(3, 4), -1);
  EXPECT_EQ(view.remove({0, 0}), std::nullopt);
  // A builder that begins anew counts from 1.
  EXPECT_TRUE(view.apply(tile({0, 0}, 1, cells)));
}

TEST(GridView, IgnoresOldVersionsAndOtherCellSizes) {
  GridView view;
  auto cells = unknown_cells();
  cells[0] = 60;
  view.apply(tile({0, 0}, 2, cells));
  EXPECT_EQ(view.apply(tile({0, 0}, 1, unknown_cells())), std::nullopt);
  auto other = tile({1, 0}, 1, cells);
  other.cell_size = 0.2;
  EXPECT_EQ(view.apply(other), std::nullopt);
  EXPECT_EQ(view.map().columns, tile_side);
}

TEST(GridView, StaysWhatItWasAfterADamagedTile) {
  GridView view;
  auto cells = unknown_cells();
  cells[0] = 60;
  view.apply(tile({0, 0}, 1, cells));
  auto damaged = tile({0, 0}, 2, unknown_cells());
  damaged.bytes.pop_back();
  EXPECT_THROW(view.apply(damaged), DamagedTile);
  EXPECT_GT(view.map().at(0, 0), 50);
}

} // namespace

} // namespace castor::mapping
