// Bytes that a scan costs working memory, on recorded robots: tiles, beside one entry for the grid.

#include "castor/mapping/grid/cell_map.hpp"
#include "castor/mapping/grid/occupancy_grid.hpp"
#include "castor/mapping/grid/tile_codec.hpp"
#include "castor/mapping/grid/tile_entries.hpp"
#include "castor/mapping/logs/carmen_log.hpp"
#include "castor/mapping/logs/rawlog.hpp"
#include "castor/wm/values/value.hpp"

#include <gtest/gtest.h>

#include <zlib.h>

#include <chrono>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <vector>

namespace castor::mapping::test {

namespace {

/// Bytes of a run-length code: a byte for the length and one for the value.
std::size_t run_length_bytes(const TileCells& cells) {
  std::size_t runs = 0;
  std::size_t length = 0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (i == 0 || cells[i] != cells[i - 1] || length == 255) {
      ++runs;
      length = 0;
    }
    ++length;
  }
  return 2 * runs;
}

std::size_t compressed_bytes(const CellMap& map) {
  auto size = compressBound(static_cast<uLong>(map.cells.size()));
  std::vector<Bytef> bytes(size);
  compress2(bytes.data(), &size, reinterpret_cast<const Bytef*>(map.cells.data()),
            static_cast<uLong>(map.cells.size()), Z_DEFAULT_COMPRESSION);
  return size;
}

struct Costs {
  std::size_t updates = 0;
  std::size_t tiles = 0;
  std::size_t bytes = 0;
  std::size_t run_length = 0;
  /// Values of entries as they cross a link.
  std::size_t values = 0;
  std::size_t whole = 0;
};

/// Inserts a scan each 0.15 m or 0.12 rad, where the wheels say that it was: drift makes the map
/// wrong, but not its entries larger or smaller.
Costs costs_of(const RobotLog& log) {
  OccupancyGrid grid;
  TileEntries entries;
  Costs result;
  std::chrono::nanoseconds time{};
  const LoggedScan* last = nullptr;
  for (auto& x : log.scans) {
    auto& pose = x.odometry.pose;
    if (last && distance(last->odometry.pose, pose) < 0.15 &&
        std::abs(normalised(pose.heading - last->odometry.pose.heading)) < 0.12)
      continue;
    last = &x;
    auto start = std::chrono::steady_clock::now();
    auto changed = entries.changed(grid, grid.insert(x.scan, pose));
    time += std::chrono::steady_clock::now() - start;
    ++result.updates;
    result.tiles += changed.size();
    for (auto& tile : changed) {
      result.bytes += tile.bytes.size();
      result.values += Value::of(tile).encoded_size();
      result.run_length += run_length_bytes(grid.cells({tile.column, tile.row}));
    }
    // One in twenty: the whole grid takes long to compress.
    if (result.updates % 20 == 0)
      result.whole += compressed_bytes(cell_map(grid)) * 20;
  }
  std::cout << result.updates << " updates of " << grid.tiles().size()
            << " tiles: " << static_cast<double>(result.tiles) / static_cast<double>(result.updates)
            << " tiles of " << result.bytes / result.tiles << " bytes, together "
            << result.bytes / result.updates << " bytes for an update ("
            << result.run_length / result.updates << " by run lengths); the value of an event "
            << result.values / result.tiles << " bytes; one entry for the grid, "
            << "compressed: " << result.whole / result.updates << " bytes; "
            << static_cast<double>(time.count()) / 1e6 / static_cast<double>(result.updates)
            << " ms for an update with its encoding\n";
  return result;
}

TEST(GridBytes, OfARawlog) {
  const std::filesystem::path file =
    "/usr/share/mrpt/datasets/2006-01ENE-21-SENA_Telecom Faculty_one_loop_only.rawlog";
  if (!exists(file))
    GTEST_SKIP() << "needs the package mrpt-common";
  auto read = read_rawlog(file);
  ASSERT_TRUE(read.rawlog);
  auto costs = costs_of(read.rawlog->log);
  EXPECT_LT(costs.bytes, costs.run_length);
  EXPECT_LT(costs.bytes, costs.whole);
}

TEST(GridBytes, OfACarmenLog) {
  const std::filesystem::path file = CASTOR_SLAM_DATA "/mit-csail.clf.gz";
  if (!exists(file))
    GTEST_SKIP() << "needs " << file;
  auto read = read_carmen_log(file);
  ASSERT_TRUE(read.log);
  auto costs = costs_of(*read.log);
  EXPECT_LT(costs.bytes, costs.run_length);
  EXPECT_LT(costs.bytes, costs.whole);
}

} // namespace

} // namespace castor::mapping::test
