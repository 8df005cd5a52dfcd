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

/// Cells are forgotten if there are more than of some 60 m x 60 m.
constexpr std::size_t most_cells = 400'000;

std::uint64_t part(double x, double size) {
  return static_cast<std::uint32_t>(static_cast<std::int32_t>(std::floor(x / size)));
}

void make_unique(std::vector<std::uint64_t>& x) {
  std::ranges::sort(x);
  x.erase(std::unique(x.begin(), x.end()), x.end());
}

} // namespace

FreeSpace::Key FreeSpace::key(const Point2& p) const {
  return part(p.x, options_.cell_size) << 32U | part(p.y, options_.cell_size);
}

int FreeSpace::count(Key x) const {
  const auto i = cells_.find(x);
  return i == cells_.end() ? 0 : i->second;
}

bool FreeSpace::was_free(const Point2& p) const {
  if (count(key(p)) > is_free)
    return false;
  for (const double dx : {-1, 0, 1})
    for (const double dy : {-1, 0, 1})
      if (count(key({p.x + dx * options_.cell_size, p.y + dy * options_.cell_size})) >= is_occupied)
        return false;
  return true;
}

void FreeSpace::add(const Point2& scanner, std::span<const Point2> ends,
                    std::span<const Point2> movers) {
  passed_.clear();
  hit_.clear();
  for (const auto& end : ends) {
    const double range = distance(scanner, end);
    const Point2 direction{(end.x - scanner.x) / range, (end.y - scanner.y) / range};
    const double until = std::min(range - options_.end, options_.range);
    for (double way = 0; way < until; way += options_.cell_size)
      passed_.push_back(key({scanner.x + way * direction.x, scanner.y + way * direction.y}));
    constexpr double reach = 0.5; // metres
    const auto is_mover = [&](const Point2& x) { return distance(x, end) < reach; };
    if (std::ranges::none_of(movers, is_mover))
      hit_.push_back(key(end));
  }
  make_unique(passed_);
  make_unique(hit_);
  for (const auto x : passed_) {
    if (std::ranges::binary_search(hit_, x))
      continue;
    auto& cell = cells_[x];
    cell = static_cast<std::int16_t>(std::max(most_free, cell + passing));
  }
  for (const auto x : hit_) {
    auto& cell = cells_[x];
    cell = static_cast<std::int16_t>(std::min(most_occupied, cell + 1));
  }
  if (cells_.size() > most_cells)
    forget_far(scanner);
}

void FreeSpace::forget_far(const Point2& scanner) {
  const auto coordinate = [&](std::uint64_t x) {
    return static_cast<std::int32_t>(static_cast<std::uint32_t>(x)) * options_.cell_size;
  };
  std::erase_if(cells_, [&](const auto& x) {
    const Point2 place{coordinate(x.first >> 32U), coordinate(x.first)};
    return distance(place, scanner) > 2 * options_.range;
  });
}

} // namespace castor::mapping
