#include "castor/mapping/people/free_space.hpp"

#include <algorithm>
#include <cmath>

namespace castor::mapping {

namespace {

/// Somebody who stands where it was free for long counts as a thing after some ten seconds.
constexpr int most_free = -100;
constexpr int most_occupied = 50;
/// A cell is free if at least two beams more have passed than have hit, and something stands there
/// if it was hit that often.
constexpr int is_free = -4;
constexpr int is_occupied = 3;
constexpr int passing = -2;
/// Somebody who walks is in a cell for less.
constexpr int settled = 10;

/// Tiles are forgotten if there are more than of some 60 m x 60 m.
constexpr std::size_t most_tiles = 400;

std::uint64_t key_of(std::int32_t tile_column, std::int32_t tile_row) {
  return std::uint64_t{static_cast<std::uint32_t>(tile_column)} << 32U |
         static_cast<std::uint32_t>(tile_row);
}

/// Rounded down, also below zero.
std::int32_t tile_of(std::int32_t cell, int side) {
  return cell >= 0 ? cell / side : -((side - 1 - cell) / side);
}

} // namespace

FreeSpace::CellIndex FreeSpace::index(const Point2& p) const {
  return {static_cast<std::int32_t>(std::floor(p.x / options_.cell_size)),
          static_cast<std::int32_t>(std::floor(p.y / options_.cell_size))};
}

int FreeSpace::count(CellIndex x) const {
  const auto column = tile_of(x.column, tile_side);
  const auto row = tile_of(x.row, tile_side);
  const auto i = tiles_.find(key_of(column, row));
  if (i == tiles_.end())
    return 0;
  const auto position = (x.row - row * tile_side) * tile_side + x.column - column * tile_side;
  return i->second[static_cast<std::size_t>(position)].count;
}

FreeSpace::Cell& FreeSpace::cell(CellIndex x) {
  const auto column = tile_of(x.column, tile_side);
  const auto row = tile_of(x.row, tile_side);
  const auto key = key_of(column, row);
  if (!last_tile_ || key != last_key_) {
    last_tile_ = &tiles_[key];
    last_key_ = key;
  }
  const auto position = (x.row - row * tile_side) * tile_side + x.column - column * tile_side;
  return (*last_tile_)[static_cast<std::size_t>(position)];
}

bool FreeSpace::was_free(const Point2& p) const {
  const auto middle = index(p);
  return count(middle) <= is_free && !is_any_hit(middle, is_occupied);
}

bool FreeSpace::is_settled(const Point2& p) const {
  return is_any_hit(index(p), settled);
}

bool FreeSpace::is_any_hit(CellIndex middle, int times) const {
  for (const std::int32_t column : {-1, 0, 1})
    for (const std::int32_t row : {-1, 0, 1})
      if (count({middle.column + column, middle.row + row}) >= times)
        return true;
  return false;
}

void FreeSpace::add(const Point2& scanner, std::span<const Point2> standing,
                    std::span<const Point2> moving) {
  ++scan_;
  for (const auto& end : standing) {
    auto& hit = cell(index(end));
    if (hit.hit != scan_)
      hit.count = static_cast<std::int16_t>(std::min(most_occupied, hit.count + 1));
    hit.hit = scan_;
  }
  for (const auto ends : {standing, moving})
    for (const auto& end : ends)
      pass(scanner, end);
  if (tiles_.size() > most_tiles)
    forget_far(scanner);
}

void FreeSpace::pass(const Point2& scanner, const Point2& end) {
  const double range = distance(scanner, end);
  const Point2 direction{(end.x - scanner.x) / range, (end.y - scanner.y) / range};
  const double until = std::min(range - options_.end, options_.range);
  for (double way = 0; way < until; way += options_.cell_size) {
    auto& x = cell(index({scanner.x + way * direction.x, scanner.y + way * direction.y}));
    if (x.passed == scan_ || x.hit == scan_)
      continue;
    x.passed = scan_;
    x.count = static_cast<std::int16_t>(std::max(most_free, x.count + passing));
  }
}

void FreeSpace::forget_far(const Point2& scanner) {
  const double side = tile_side * options_.cell_size;
  const auto middle = [&](std::uint64_t x) {
    return (static_cast<double>(static_cast<std::int32_t>(static_cast<std::uint32_t>(x))) + 0.5) *
           side;
  };
  std::erase_if(tiles_, [&](const auto& x) {
    return distance({middle(x.first >> 32U), middle(x.first)}, scanner) > 2 * options_.range;
  });
  last_tile_ = nullptr;
}

} // namespace castor::mapping
