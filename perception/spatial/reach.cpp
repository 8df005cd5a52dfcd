#include "castor/perception/spatial/reach.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <utility>
#include <vector>

namespace castor::spatial {

namespace {

/// On both sides, or the same twice where it is on one.
using Sides = std::pair<std::size_t, std::size_t>;

constexpr double index_rounding = 1e-6;

Sides sides(double cell) {
  const auto below = static_cast<std::size_t>(std::floor(cell + index_rounding));
  return {below, static_cast<std::size_t>(std::ceil(cell - index_rounding))};
}

Sides heights_beside(const ReachableTable& reach, double height) {
  const auto above = std::ranges::lower_bound(reach.heights, height - index_rounding);
  const auto index = static_cast<std::size_t>(above - reach.heights.begin());
  if (index == reach.heights.size())
    return {index - 1, index - 1};
  return {index == 0 || *above < height + index_rounding ? index : index - 1, index};
}

/// Ways at each of the points and heights around; none beyond the grid.
std::vector<std::uint32_t> all_around(const ReachableTable& reach, const GroundPoint& point,
                                      double height) {
  if (reach.ways.size() != reach.heights.size() * reach.rows * reach.columns ||
      reach.heights.empty())
    throw std::invalid_argument("a reachable table does not have as many ways as points and "
                                "heights");
  const double x = (point.x - reach.low.x) / reach.step;
  const double y = (point.y - reach.low.y) / reach.step;
  if (!(x >= -index_rounding && y >= -index_rounding && x <= reach.columns - 1 + index_rounding &&
        y <= reach.rows - 1 + index_rounding))
    return {0};
  const auto columns = sides(x);
  const auto rows = sides(y);
  const auto heights = heights_beside(reach, height);
  std::vector<std::uint32_t> result;
  for (const auto layer : {heights.first, heights.second})
    for (const auto row : {rows.first, rows.second})
      for (const auto column : {columns.first, columns.second})
        result.push_back(reach.ways[(layer * reach.rows + row) * reach.columns + column]);
  return result;
}

} // namespace

std::uint32_t ways_at(const ReachableTable& reach, const GroundPoint& point, double height) {
  auto result = ~std::uint32_t{0};
  for (const auto ways : all_around(reach, point, height))
    result &= ways;
  return result;
}

std::uint32_t ways_around(const ReachableTable& reach, const GroundPoint& point, double height) {
  std::uint32_t result = 0;
  for (const auto ways : all_around(reach, point, height))
    result |= ways;
  return result;
}

std::uint32_t ways_by_way_of(const ReachableTable& reach, double height, std::uint32_t ways) {
  std::uint32_t result = 0;
  for (std::uint32_t row = 0; row < reach.rows; ++row)
    for (std::uint32_t column = 0; column < reach.columns; ++column) {
      const GroundPoint point{reach.low.x + column * reach.step, reach.low.y + row * reach.step};
      if (const auto there = ways_at(reach, point, height); (there & ways) != 0)
        result |= there;
    }
  return result;
}

ReachOfThing::ReachOfThing(ReachableTable reach, double height, std::uint32_t ways)
  : reach_(std::move(reach)), height_(height), ways_(ways),
    ways_by_stop_(ways_by_way_of(reach_, height, ways)) {
  // nop
}

Reach ReachOfThing::at(const GroundPoint& point) const {
  const auto there = ways_at(reach_, point, height_);
  if ((there & ways_) != 0)
    return Reach::direct;
  if ((there & ways_by_stop_) != 0)
    return Reach::by_stop;
  return ways_around(reach_, point, height_) != 0 ? Reach::perhaps : Reach::none;
}

Reach ReachOfThing::at_and_onward(const GroundPoint& point, const GroundPoint& onward) const {
  const auto here = at(point);
  if (here == Reach::none || here == Reach::perhaps)
    return here;
  const auto both = ways_at(reach_, point, height_) & ways_at(reach_, onward, height_);
  return both == 0 ? Reach::perhaps : here;
}

std::vector<Reach> ReachOfThing::on_squares() const {
  std::vector<Reach> result;
  for (std::uint32_t row = 0; row + 1 < reach_.rows; ++row)
    for (std::uint32_t column = 0; column + 1 < reach_.columns; ++column)
      result.push_back(at(
        {reach_.low.x + (column + 0.5) * reach_.step, reach_.low.y + (row + 0.5) * reach_.step}));
  return result;
}

} // namespace castor::spatial
