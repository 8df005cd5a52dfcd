#include "castor/benchmarks/exploration/exploration_evaluation.hpp"

#include "castor/mapping/building/solid_obstacles.hpp"
#include "castor/mapping/building/solids.hpp"
#include "castor/mapping/planar/poses.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
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

std::vector<FloorCell> reachable_cells(const ReachableFloor& floor) {
  std::vector<FloorCell> result;
  for (int row = 0; row < floor.rows(); ++row)
    for (int column = 0; column < floor.columns(); ++column)
      if (floor.can_be_at(column, row))
        result.emplace_back(column, row);
  return result;
}

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
  const SolidObstacles obstacles(between_heights(solids_of(building), 0, checked_robot_height));
  const auto cells = reachable_cells(floor);
  if (cells.empty())
    return 0;
  const auto centre = [&](const FloorCell& x) { return floor.centre(x.first, x.second); };
  const Point2 start{building.start.x, building.start.y};
  const auto first = *std::ranges::min_element(
    cells, {}, [&](const FloorCell& x) { return distance(centre(x), start); });
  std::vector<std::vector<FloorCell>> regions{{first}};
  std::vector<std::vector<double>> ways{ways_from(floor, regions.front())};
  for (const auto& room : building.rooms) {
    const FloorCell* farthest = nullptr;
    for (const auto& x : cells)
      if (room_at(building, centre(x)) == &room &&
          (!farthest || ways.front()[floor.position(x.first, x.second)] >
                          ways.front()[floor.position(farthest->first, farthest->second)]))
        farthest = &x;
    if (!farthest)
      continue;
    const auto witness = centre(*farthest);
    std::vector<FloorCell> region;
    for (const auto& x : cells) {
      const auto p = centre(x);
      const double away = distance(p, witness);
      if (away <= sight &&
          !obstacles.cast(witness, std::atan2(p.y - witness.y, p.x - witness.x), away))
        region.push_back(x);
    }
    ways.push_back(ways_from(floor, region));
    regions.push_back(std::move(region));
  }
  std::vector<std::vector<double>> distances(regions.size(),
                                             std::vector<double>(regions.size(), never));
  for (std::size_t i = 0; i < regions.size(); ++i)
    for (std::size_t j = 0; j < regions.size(); ++j)
      for (const auto& x : regions[j])
        distances[i][j] = std::min(distances[i][j], ways[i][floor.position(x.first, x.second)]);
  return spanning_tree(distances) / detour_of_cells;
}

} // namespace castor::mapping
