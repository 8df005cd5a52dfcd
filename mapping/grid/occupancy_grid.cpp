#include "castor/mapping/grid/occupancy_grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace castor::mapping {

namespace {

/// Log-odds beyond this have no quantised value of 8 bits.
constexpr double most_log_odds = 100 * quantum;

/// A count that has reached its limit stays below it: the cell forgets, but does not overflow.
void change_count(std::uint16_t& count, int change) {
  constexpr int most = std::numeric_limits<std::uint16_t>::max();
  count = static_cast<std::uint16_t>(std::clamp(count + change, 0, most));
}

} // namespace

OccupancyGrid::OccupancyGrid(OccupancyGridOptions options) : options_(options) {
  auto& x = options_;
  if (!(x.cells.cell_size > 0) || !(x.cells.max_range > 0))
    throw std::invalid_argument("the cell size and the maximal range have to be more than 0");
  if (!(x.hit > 0 && x.pass < 0 && x.most > 0 && x.least < 0))
    throw std::invalid_argument(
      "log-odds have to be positive for a hit and its limit, and negative "
      "for a pass and its limit");
  if (x.most > most_log_odds || x.least < -most_log_odds)
    throw std::invalid_argument("the limits of log-odds have to be within -5 and 5");
}

std::set<TileIndex> OccupancyGrid::insert(const LaserScan& scan, const Pose2& robot) {
  return update(cells_of(scan, robot, options_.cells), 1);
}

std::set<TileIndex> OccupancyGrid::remove(const LaserScan& scan, const Pose2& robot) {
  return update(cells_of(scan, robot, options_.cells), -1);
}

std::set<TileIndex> OccupancyGrid::update(const ScanCells& cells, int change) {
  std::set<TileIndex> result;
  // The last tile is kept at hand, as neighbours in the list are mostly in the same one.
  TileIndex index;
  Tile* tile = nullptr;
  auto counts = [&](const Cell& cell) -> Counts& {
    if (auto x = tile_of(cell); !tile || x != index) {
      index = x;
      tile = &tiles_[index];
      result.insert(index);
    }
    return (*tile)[position_in_tile(cell)];
  };
  for (auto& x : cells.hits)
    change_count(counts(x).hits, change);
  for (auto& x : cells.passes)
    change_count(counts(x).passes, change);
  return result;
}

std::int8_t OccupancyGrid::value(const Counts& counts) const {
  if (counts.hits == 0 && counts.passes == 0)
    return unknown_cell;
  auto sum = counts.hits * options_.hit + counts.passes * options_.pass;
  return static_cast<std::int8_t>(
    std::lround(std::clamp(sum, options_.least, options_.most) / quantum));
}

std::int8_t OccupancyGrid::at(const Cell& cell) const {
  auto found = tiles_.find(tile_of(cell));
  return found == tiles_.end() ? unknown_cell : value(found->second[position_in_tile(cell)]);
}

std::vector<TileIndex> OccupancyGrid::tiles() const {
  std::vector<TileIndex> result;
  result.reserve(tiles_.size());
  for (auto& [index, tile] : tiles_)
    result.push_back(index);
  std::ranges::sort(result);
  return result;
}

TileCells OccupancyGrid::cells(const TileIndex& tile) const {
  TileCells result;
  result.fill(unknown_cell);
  if (auto found = tiles_.find(tile); found != tiles_.end())
    std::ranges::transform(found->second, result.begin(), [this](auto& x) { return value(x); });
  return result;
}

} // namespace castor::mapping
