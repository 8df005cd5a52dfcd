#include "castor/wm/filters/region_table.hpp"

#include <algorithm>
#include <limits>

namespace castor {

namespace {

/// Cells of 2^level are as wide as the widest side, and no narrower than what a double can tell
/// apart at the region's distance from zero.
int level_of(const std::vector<Interval>& region) {
  double width = 0;
  double reach = 0;
  for (auto& side : region) {
    width = std::max(width, side.high - side.low);
    reach = std::max({reach, std::abs(side.low), std::abs(side.high)});
  }
  auto size = std::max(width, reach * 0x1p-50);
  if (!std::isfinite(size))
    return std::numeric_limits<double>::max_exponent;
  return size > 0 ? std::ilogb(size) + 1 : 0;
}

} // namespace

template <class F>
void RegionTable::for_each_cell(const std::vector<Interval>& region, int level, F&& f) {
  Cell first{};
  Cell last{};
  for (std::size_t i = 0; i < region.size(); ++i) {
    first[i] = cell_coordinate(region[i].low, level);
    last[i] = cell_coordinate(region[i].high, level);
  }
  for (auto x = first[0]; x <= last[0]; ++x)
    for (auto y = first[1]; y <= last[1]; ++y)
      for (auto z = first[2]; z <= last[2]; ++z)
        f(Cell{x, y, z});
}

void RegionTable::insert(const std::vector<Interval>& region, RegisteredFilter* filter) {
  ++size_;
  auto level = level_of(region);
  for_each_cell(region, level, [&](const Cell& cell) { grids_[level][cell].push_back(filter); });
}

void RegionTable::erase(const std::vector<Interval>& region, RegisteredFilter* filter) {
  --size_;
  auto level = level_of(region);
  for_each_cell(region, level, [&](const Cell& cell) {
    auto& grid = grids_.at(level);
    auto& filters = grid.at(cell);
    std::erase(filters, filter);
    if (filters.empty())
      grid.erase(cell);
    if (grid.empty())
      grids_.erase(level);
  });
}

} // namespace castor
