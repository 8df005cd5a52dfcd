#include "castor/benchmarks/exploration/exploration_evaluation.hpp"

#include "castor/mapping/building/solid_obstacles.hpp"
#include "castor/mapping/building/solids.hpp"
#include "castor/mapping/planar/poses.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iterator>
#include <limits>
#include <numbers>
#include <queue>
#include <utility>
#include <vector>

namespace castor::mapping {

namespace {

constexpr double never = std::numeric_limits<double>::infinity();
/// Of a way in steps of 45 degrees to the straight one, at most: 1 / cos(22.5 degrees).
constexpr double detour_of_cells = 1.0824;

using FloorCell = std::pair<int, int>;

/// Ways from the nearest of several cells to all others.
std::vector<double> ways_from(const ReachableFloor& floor, const std::vector<FloorCell>& sources) {
  std::vector<double> result(
    static_cast<std::size_t>(floor.columns()) * static_cast<std::size_t>(floor.rows()), never);
  using Item = std::pair<double, FloorCell>;
  std::priority_queue<Item, std::vector<Item>, std::greater<>> waiting;
  for (const auto& x : sources) {
    result[floor.position(x.first, x.second)] = 0;
    waiting.emplace(0.0, x);
  }
  while (!waiting.empty()) {
    const auto [way, cell] = waiting.top();
    waiting.pop();
    if (way > result[floor.position(cell.first, cell.second)])
      continue;
    for (int y = -1; y <= 1; ++y)
      for (int x = -1; x <= 1; ++x) {
        const FloorCell next{cell.first + x, cell.second + y};
        if (next.first < 0 || next.second < 0 || next.first >= floor.columns() ||
            next.second >= floor.rows() || !floor.can_be_at(next.first, next.second))
          continue;
        const double longer = way + floor.cell() * std::hypot(x, y);
        auto& known = result[floor.position(next.first, next.second)];
        if (longer < known) {
          known = longer;
          waiting.emplace(longer, next);
        }
      }
  }
  return result;
}

/// From where on the floor its points are seen, by a coarser grid than that of the floor.
class ViewPoints {
public:
  ViewPoints(const Building& building, const ReachableFloor& floor, double sight)
    : floor_(floor), sight_(sight),
      obstacles_(between_heights(solids_of(building), 0, checked_robot_height)) {
    for_each_sample([&](int column, int row) {
      if (floor.can_be_at(column, row))
        cells_.emplace_back(column, row);
    });
  }

  /// Where the robot can be.
  const std::vector<FloorCell>& cells() const { return cells_; }

  /// What distances between regions may be too long by, metres.
  double rounding() const { return stride * floor_.cell() * std::numbers::sqrt2; }

  FloorCell nearest_to(const Point2& p) const {
    return *std::ranges::min_element(cells_, {},
                                     [&](const FloorCell& x) { return distance(centre(x), p); });
  }

  /// Regions from which points of the floor are seen that are hard to see; they do not overlap.
  std::vector<std::vector<FloorCell>> hidden_regions() const {
    std::vector<std::vector<std::size_t>> all;
    for_each_sample([&](int column, int row) {
      if (!floor_.can_cover(column, row))
        return;
      if (auto region = region_of(floor_.centre(column, row)); !region.empty())
        all.push_back(std::move(region));
    });
    std::ranges::stable_sort(all, {}, &std::vector<std::size_t>::size);
    std::vector<bool> is_taken(cells_.size());
    std::vector<std::vector<FloorCell>> result;
    for (const auto& region : all) {
      if (std::ranges::any_of(region, [&](std::size_t i) { return is_taken[i]; }))
        continue;
      result.emplace_back();
      for (auto i : region) {
        is_taken[i] = true;
        result.back().push_back(cells_[i]);
      }
    }
    return result;
  }

private:
  static constexpr int stride = 4;

  template <class F>
  void for_each_sample(F f) const {
    for (int row = 0; row < floor_.rows(); row += stride)
      for (int column = 0; column < floor_.columns(); column += stride)
        f(column, row);
  }

  Point2 centre(const FloorCell& x) const { return floor_.centre(x.first, x.second); }

  std::vector<std::size_t> region_of(const Point2& seen) const {
    std::vector<std::size_t> result;
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      const auto p = centre(cells_[i]);
      const double away = distance(p, seen);
      if (away <= sight_ && !obstacles_.cast(seen, std::atan2(p.y - seen.y, p.x - seen.x), away))
        result.push_back(i);
    }
    return result;
  }

  const ReachableFloor& floor_;
  double sight_;
  SolidObstacles obstacles_;
  std::vector<FloorCell> cells_;
};

/// Length of the minimal spanning tree of nodes with these distances (R. C. Prim, 1957).
double spanning_tree(const std::vector<std::vector<double>>& distances) {
  std::vector<double> nearest(distances.size(), never);
  std::vector<bool> is_in(distances.size());
  nearest.front() = 0;
  double result = 0;
  for (std::size_t i = 0; i < distances.size(); ++i) {
    std::size_t next = distances.size();
    for (std::size_t j = 0; j < distances.size(); ++j)
      if (!is_in[j] && (next == distances.size() || nearest[j] < nearest[next]))
        next = j;
    is_in[next] = true;
    result += nearest[next];
    for (std::size_t j = 0; j < distances.size(); ++j)
      nearest[j] = std::min(nearest[j], distances[next][j]);
  }
  return result;
}

/// That of the nodes of which none can be left out so that it becomes longer; the first stays.
double greatest_spanning_tree(std::vector<std::vector<double>> distances) {
  double result = spanning_tree(distances);
  for (std::size_t i = 1; i < distances.size();) {
    auto without = distances;
    without.erase(without.begin() + static_cast<std::ptrdiff_t>(i));
    for (auto& row : without)
      row.erase(row.begin() + static_cast<std::ptrdiff_t>(i));
    if (const double longer = spanning_tree(without); longer > result) {
      result = longer;
      distances = std::move(without);
      i = 1;
    } else {
      ++i;
    }
  }
  return result;
}

} // namespace

SeenFloor seen_floor(const Building& building, const ReachableFloor& floor, const CellMap& map,
                     const Pose2& frame) {
  const SolidObstacles obstacles(between_heights(solids_of(building), 0, checked_robot_height));
  const double half_diagonal = floor.cell() / std::numbers::sqrt2;
  const auto to_map = inverse(compose(frame, map.origin));
  double covered = 0;
  double open = 0;
  SeenFloor result;
  for (int row = 0; row < floor.rows(); ++row)
    for (int column = 0; column < floor.columns(); ++column) {
      if (!floor.can_cover(column, row))
        continue;
      const auto place = floor.centre(column, row);
      const bool is_open = obstacles.clearance(place, 2 * half_diagonal) >= half_diagonal;
      ++covered;
      open += is_open ? 1 : 0;
      const auto p = transform(to_map, place);
      const int x = static_cast<int>(std::floor(p.x / map.cell_size));
      const int y = static_cast<int>(std::floor(p.y / map.cell_size));
      if (x < 0 || y < 0 || x >= map.columns || y >= map.rows || map.at(x, y) < 0)
        continue;
      ++result.known;
      if (map.at(x, y) >= 50)
        continue;
      ++result.free;
      result.free_of_open += is_open ? 1 : 0;
    }
  if (covered > 0) {
    result.known /= covered;
    result.free /= covered;
  }
  if (open > 0)
    result.free_of_open /= open;
  return result;
}

double shortest_exploration(const Building& building, const ReachableFloor& floor, double sight) {
  const ViewPoints views(building, floor, sight);
  if (views.cells().empty())
    return 0;
  const Point2 start{building.start.x, building.start.y};
  std::vector<std::vector<FloorCell>> regions{{views.nearest_to(start)}};
  std::ranges::copy(views.hidden_regions(), std::back_inserter(regions));
  std::vector<std::vector<double>> distances(regions.size(),
                                             std::vector<double>(regions.size(), never));
  for (std::size_t i = 0; i < regions.size(); ++i) {
    const auto ways = ways_from(floor, regions[i]);
    for (std::size_t j = 0; j < regions.size(); ++j) {
      for (const auto& x : regions[j])
        distances[i][j] = std::min(distances[i][j], ways[floor.position(x.first, x.second)]);
      distances[i][j] = std::max(0.0, distances[i][j] / detour_of_cells - views.rounding());
    }
  }
  return greatest_spanning_tree(std::move(distances));
}

} // namespace castor::mapping
