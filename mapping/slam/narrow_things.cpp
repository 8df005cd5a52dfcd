#include "castor/mapping/slam/narrow_things.hpp"

#include "castor/mapping/planar/beams.hpp"
#include "castor/mapping/planar/poses.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

namespace castor::mapping {

namespace {

/// Beams that end close together, from the first to the last.
struct Cluster {
  std::size_t first = 0;
  std::size_t last = 0;
  bool is_narrow = false;
};

std::vector<Cluster> clusters(const LaserScan& scan, const NarrowOptions& options) {
  std::vector<Cluster> result;
  Point2 before;
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
    if (!(scan.ranges[i] > 0))
      continue;
    const auto end = end_of_beam(scan, i);
    const double most =
      std::max<double>(options.same_thing, options.same_thing_share * scan.ranges[i]);
    if (!result.empty() && result.back().last + 1 == i && distance(before, end) <= most)
      result.back().last = i;
    else
      result.push_back({i, i});
    before = end;
  }
  return result;
}

/// Whether the beam beside an edge goes on behind it. Where nothing came back it does.
bool passes(const LaserScan& scan, std::size_t edge, std::size_t beside) {
  return beside < scan.ranges.size() &&
         (!(scan.ranges[beside] > 0) || scan.ranges[beside] > scan.ranges[edge]);
}

/// Whether it stands alone as far as is known: something before it may hide one side.
bool is_alone(const LaserScan& scan, const std::vector<Cluster>& all, std::size_t i,
              const NarrowOptions& options) {
  const auto& x = all[i];
  // Below 0 is beyond the end as well.
  const bool passes_right = passes(scan, x.first, x.first - 1);
  const bool passes_left = passes(scan, x.last, x.last + 1);
  const auto is_hidden_by = [&](std::size_t other) {
    return other < all.size() &&
           (all[other].is_narrow || x.last - x.first + 1 >= options.least_beams);
  };
  return (passes_right && passes_left) || (passes_right && is_hidden_by(i + 1)) ||
         (passes_left && is_hidden_by(i - 1));
}

} // namespace

LaserScan without_narrow_things(LaserScan scan, const NarrowOptions& options) {
  auto all = clusters(scan, options);
  // Who is hidden by somebody is known after him.
  for (bool has_found = true; std::exchange(has_found, false);)
    for (std::size_t i = 0; i < all.size(); ++i) {
      auto& x = all[i];
      if (x.is_narrow || !is_alone(scan, all, i, options) ||
          distance(end_of_beam(scan, x.first), end_of_beam(scan, x.last)) > options.widest)
        continue;
      x.is_narrow = has_found = true;
    }
  for (const auto& x : all)
    if (x.is_narrow)
      std::fill(scan.ranges.begin() + static_cast<std::ptrdiff_t>(x.first),
                scan.ranges.begin() + static_cast<std::ptrdiff_t>(x.last) + 1, 0.F);
  return scan;
}

} // namespace castor::mapping
