// The occupancy grid: evidence, its removal, keyframes whose poses are corrected.

#include "castor/mapping/grid/cell_map.hpp"
#include "castor/mapping/grid/keyframe_grid.hpp"
#include "castor/mapping/grid/occupancy_grid.hpp"
#include "castor/mapping/grid/tile_codec.hpp"
#include "castor/mapping/grid/tile_entries.hpp"

#include "castor/tests/mapping/grid/box_room.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <memory>
#include <stdexcept>
#include <string>

namespace castor::mapping::test {

namespace {

constexpr BoxRoom room{-4.02, 6.02, -3.02, 5.02};

bool is_occupied(std::int8_t cell) {
  return cell != unknown_cell && cell > 0;
}

bool is_free(std::int8_t cell) {
  return cell != unknown_cell && cell < 0;
}

bool equal(const OccupancyGrid& a, const OccupancyGrid& b) {
  for (auto& grid : {&a, &b})
    for (auto& tile : grid->tiles())
      if (a.cells(tile) != b.cells(tile))
        return false;
  return true;
}

TEST(OccupancyGrid, WallsAreOccupiedAndTheRoomIsFree) {
  OccupancyGrid grid;
  for (auto x : {-2., 0., 2., 4.}) {
    Pose2 robot{x, 0.5, 0.7};
    grid.insert(room.scan(robot), robot);
  }
  auto at = [&](double x, double y) { return grid.at(cell_of({x, y}, grid.cell_size())); };
  for (double y = -2.9; y < 4.9; y += 0.1) {
    EXPECT_TRUE(is_occupied(at(room.left, y)) || is_occupied(at(room.left - 0.05, y))) << y;
    EXPECT_TRUE(is_free(at(room.left + 0.1, y))) << y;
    EXPECT_EQ(at(room.left - 0.1, y), unknown_cell) << y;
  }
  EXPECT_TRUE(is_free(at(0, 0)));
}

TEST(OccupancyGrid, RepeatedEvidenceReachesTheLimits) {
  OccupancyGrid grid;
  Pose2 robot{0.025, 0.025, 0};
  for (int i = 0; i < 100; ++i)
    grid.insert(room.scan(robot, 4), robot);
  EXPECT_NEAR(quantum * grid.at(cell_of({0.5, 0.025}, 0.05)), grid.options().least, quantum);
  EXPECT_NEAR(quantum * grid.at(cell_of({room.right, 0.025}, 0.05)), grid.options().most, quantum);
}

TEST(OccupancyGrid, ReportsTheTilesThatItTouches) {
  OccupancyGrid grid;
  LaserScan scan;
  scan.ranges = {5};
  // 64 cells of 5 cm are 3.2 m.
  auto touched = grid.insert(scan, {-0.1, 0.1, 0});
  EXPECT_EQ(touched, (std::set<TileIndex>{{-1, 0}, {0, 0}, {1, 0}}));
  auto tiles = grid.tiles();
  EXPECT_EQ(std::set<TileIndex>(tiles.begin(), tiles.end()), touched);
}

TEST(OccupancyGrid, UnsuitableOptionsAreRefused) {
  auto with = [](auto change) {
    OccupancyGridOptions options;
    change(options);
    return options;
  };
  EXPECT_THROW(OccupancyGrid(with([](auto& x) { x.cells.cell_size = 0; })), std::invalid_argument);
  EXPECT_THROW(OccupancyGrid(with([](auto& x) { x.pass = 0.4; })), std::invalid_argument);
  EXPECT_THROW(OccupancyGrid(with([](auto& x) { x.most = 7; })), std::invalid_argument);
}

RC_GTEST_PROP(OccupancyGrid, ARemovedScanLeavesNoTrace, ()) {
  auto number = [] { return *rc::gen::inRange(-2500, 2500) / 1000.; };
  auto pose = [&]() -> Pose2 { return {number(), number(), number()}; };
  auto first = pose();
  auto second = pose();
  auto third = pose();
  OccupancyGrid grid;
  OccupancyGrid without;
  for (auto& robot : {first, second, third})
    grid.insert(room.scan(robot, 90), robot);
  // In another order.
  for (auto& robot : {third, first})
    without.insert(room.scan(robot, 90), robot);
  RC_ASSERT(!equal(grid, without));
  grid.remove(room.scan(second, 90), second);
  RC_ASSERT(equal(grid, without));
}

RC_GTEST_PROP(KeyframeGrid, AfterCorrectionsItIsTheGridOfTheCorrectedPoses, ()) {
  auto number = [] { return *rc::gen::inRange(-2500, 2500) / 1000.; };
  KeyframeGrid corrected{{}, {0, 0}};
  OccupancyGrid expected;
  for (int i = 0; i < 5; ++i) {
    Pose2 truth{number(), number(), number()};
    auto scan = std::make_shared<LaserScan>(room.scan(truth, 90));
    auto name = std::to_string(i);
    corrected.place(name, scan, {truth.x + number(), truth.y, truth.heading + 0.1});
    corrected.place(name, nullptr, truth);
    expected.insert(*scan, truth);
  }
  RC_ASSERT(corrected.size() == 5U);
  RC_ASSERT(equal(corrected.grid(), expected));
  for (int i = 0; i < 5; ++i)
    corrected.remove(std::to_string(i));
  RC_ASSERT(equal(corrected.grid(), OccupancyGrid{}));
}

TEST(KeyframeGrid, ChangesOnlyTheTilesOfTheKeyframeThatMoved) {
  KeyframeGrid grid;
  auto scan = std::make_shared<LaserScan>();
  scan->ranges = {1};
  grid.place("far", scan, {100, 100, 0});
  grid.place("near", scan, {1, 1, 0});
  EXPECT_EQ(grid.place("near", scan, {7, 1, 0}), (std::set<TileIndex>{{0, 0}, {2, 0}}));
}

TEST(KeyframeGrid, SmallCorrectionsWaitUntilTheyAddUp) {
  KeyframeGrid grid;
  auto scan = std::make_shared<LaserScan>(room.scan({}));
  EXPECT_FALSE(grid.place("a", scan, {}).empty());
  EXPECT_TRUE(grid.place("a", scan, {0.02, 0, 0}).empty());
  EXPECT_FALSE(grid.place("a", scan, {0.04, 0, 0}).empty());
}

TEST(CellMap, IsTheSmallestRectangleOfKnownCells) {
  OccupancyGrid grid;
  LaserScan scan;
  scan.ranges = {1};
  grid.insert(scan, {-0.5, 2.01, 0});
  auto map = cell_map(grid);
  EXPECT_EQ(map.columns, 21);
  EXPECT_EQ(map.rows, 1);
  EXPECT_NEAR(map.origin.x, -0.5, 1e-9);
  EXPECT_NEAR(map.origin.y, 2, 1e-9);
  EXPECT_EQ(map.at(20, 0), 70);
  EXPECT_EQ(map.at(0, 0), 40);
}

TEST(CellMap, OfTileEntriesIsThatOfTheGrid) {
  OccupancyGrid grid;
  grid.insert(room.scan({}), {});
  std::vector<GridTile> entries;
  for (auto& x : grid.tiles())
    entries.push_back({x.column, x.row, 1, grid.cell_size(), encode_tile(grid.cells(x))});
  EXPECT_GT(entries.size(), 4U);
  EXPECT_EQ(cell_map(entries), cell_map(grid));
  EXPECT_EQ(cell_map(std::vector<GridTile>{}).columns, 0);
}

TEST(TileEntries, OnlyChangedTilesAreWritten) {
  OccupancyGrid grid;
  TileEntries entries;
  auto touched = grid.insert(room.scan({}), {});
  auto first = entries.changed(grid, touched);
  EXPECT_EQ(first.size(), touched.size());
  EXPECT_EQ(first[0].version, 1U);
  EXPECT_TRUE(entries.changed(grid, touched).empty());
  LaserScan scan;
  scan.ranges = {1};
  auto second = entries.changed(grid, grid.insert(scan, {0.1, 0.1, 0}));
  ASSERT_EQ(second.size(), 1U);
  EXPECT_EQ(second[0].version, 2U);
  EXPECT_EQ(decode_tile(second[0].bytes), grid.cells({0, 0}));
  // After a restart.
  TileEntries successor;
  for (auto& x : first)
    successor.adopt(x);
  auto again = successor.changed(grid, touched);
  ASSERT_EQ(again.size(), 1U);
  EXPECT_EQ(again[0].version, 2U);
  EXPECT_EQ(successor.tiles(), touched);
  EXPECT_EQ(id_of(TileIndex{3, -2}), "tile 3 -2");
}

TEST(TileEntries, CellsAtTheirLimitsAreNoChange) {
  OccupancyGrid grid;
  TileEntries entries;
  for (int i = 0; i < 20; ++i)
    entries.changed(grid, grid.insert(room.scan({}), {}));
  EXPECT_TRUE(entries.changed(grid, grid.insert(room.scan({}), {})).empty());
}

} // namespace

} // namespace castor::mapping::test
