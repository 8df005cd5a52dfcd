#include "castor/mapping/movement/path_planner.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <queue>
#include <utility>

namespace castor::mapping {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr auto no_cell = std::numeric_limits<std::uint32_t>::max();

struct Neighbour {
  int column;
  int row;
  float length;
};
constexpr float diagonal = std::numbers::sqrt2_v<float>;
constexpr std::array<Neighbour, 8> neighbours{{{1, 0, 1},
                                               {-1, 0, 1},
                                               {0, 1, 1},
                                               {0, -1, 1},
                                               {1, 1, diagonal},
                                               {1, -1, diagonal},
                                               {-1, 1, diagonal},
                                               {-1, -1, diagonal}}};

/// Calls `visit(neighbour, length in cells)` for those within the map.
template <class F>
void for_neighbours(const ClearanceMap& map, std::uint32_t cell, F visit) {
  const int columns = map.columns();
  const int column = static_cast<int>(cell) % columns;
  const int row = static_cast<int>(cell) / columns;
  for (auto& x : neighbours) {
    const int c = column + x.column;
    const int r = row + x.row;
    if (c >= 0 && r >= 0 && c < columns && r < map.rows())
      visit(static_cast<std::uint32_t>(r * columns + c), x.length);
  }
}

class Planner {
public:
  Planner(const CellMap& map, const ClearanceMap& clearance, const PlanOptions& options)
    : map_(map), clearance_(clearance), options_(options),
      needed_(options.radius + options.margin) {}

  PlannedPath plan(const Point2& start, const Point2& goal) {
    const auto goal_cell = clearance_.cell_at(goal);
    if (auto reason = goal_problem(goal_cell); !reason.empty())
      return {{}, 0, reason};
    start_ = start;
    auto start_cell = nearest_fit(start);
    std::vector<std::uint32_t> cells;
    if (start_cell)
      cells = search(*start_cell, static_cast<std::uint32_t>(*goal_cell));
    if (cells.empty() && options_.escape > 0) {
      escapes_ = true;
      if (const auto tight = nearest_fit(start)) {
        start_cell = tight;
        cells = search(*tight, static_cast<std::uint32_t>(*goal_cell));
      }
    }
    if (!start_cell)
      return {{},
              0,
              fmt::format("the robot is too near to obstacles: within {:.2f} m of {:.2f} {:.2f} no "
                          "place has {:.2f} m around it",
                          options_.start_tolerance, start.x, start.y, needed_)};
    if (cells.empty())
      return {{},
              0,
              options_.explains ? why_no_way(*start_cell, static_cast<std::uint32_t>(*goal_cell))
                                : "no way"};
    PlannedPath result;
    result.points = straightened(points_of(cells, start, goal));
    for (std::size_t i = 1; i < result.points.size(); ++i)
      result.length += distance(result.points[i - 1], result.points[i]);
    return result;
  }

private:
  std::string goal_problem(const std::optional<std::size_t>& goal) const {
    if (!goal)
      return "the goal is not explored yet: it is outside the map";
    const auto cell = map_.cells[*goal];
    if (cell < 0 && options_.cells.unknown_is_obstacle)
      return "the goal is not explored yet";
    if (cell >= options_.cells.occupied_from)
      return "the goal is inside an obstacle";
    if (clearance_.at(*goal) < needed_)
      return fmt::format("the goal is {:.2f} m from an obstacle, or from what is not explored yet; "
                         "the robot needs {:.2f} m",
                         clearance_.at(*goal), needed_);
    return {};
  }

  std::optional<std::uint32_t> nearest_fit(const Point2& start) const {
    std::optional<std::uint32_t> best;
    double least = options_.start_tolerance;
    const int reach = static_cast<int>(std::ceil(least / clearance_.cell_size()));
    for (int row = -reach; row <= reach; ++row)
      for (int column = -reach; column <= reach; ++column) {
        const auto cell = clearance_.cell_at(
          {start.x + column * clearance_.cell_size(), start.y + row * clearance_.cell_size()});
        if (!cell || !fits(clearance_.centre(*cell)))
          continue;
        const double away = distance(clearance_.centre(*cell), start);
        if (away <= least) {
          least = away;
          best = static_cast<std::uint32_t>(*cell);
        }
      }
    return best;
  }

  /// Whether there is enough clearance at a place.
  bool fits(const Point2& place) const {
    const double clearance = clearance_.at(place);
    return clearance >= needed_ ||
           (escapes_ && clearance >= options_.radius + options_.tight_margin &&
            distance(place, start_) < options_.escape);
  }

  bool fits(std::size_t cell) const {
    return clearance_.at(cell) >= needed_ || (escapes_ && fits(clearance_.centre(cell)));
  }

  /// Cost of a metre at a place; infinite without enough clearance.
  double rate(const Point2& place) const {
    return fits(place) ? rate(clearance_.at(place)) : infinite;
  }

  /// The same for a clearance that is enough.
  double rate(double clearance) const {
    if (clearance >= options_.preferred_clearance)
      return 1;
    const double share =
      (options_.preferred_clearance - clearance) / (options_.preferred_clearance - needed_);
    return 1 + options_.narrowness * share;
  }

  /// Whether a diagonal step touches a cell without enough clearance.
  bool cuts_corner(std::uint32_t from, std::uint32_t to) const {
    const auto columns = static_cast<std::uint32_t>(clearance_.columns());
    const auto first = from / columns * columns + to % columns;
    const auto second = to / columns * columns + from % columns;
    return !fits(first) || !fits(second);
  }

  std::vector<std::uint32_t> search(std::uint32_t start, std::uint32_t goal) const {
    const auto size = map_.cells.size();
    std::vector<float> cost(size, std::numeric_limits<float>::infinity());
    std::vector<std::uint32_t> from(size, no_cell);
    const int columns = clearance_.columns();
    const int goal_column = static_cast<int>(goal) % columns;
    const int goal_row = static_cast<int>(goal) / columns;
    auto rest = [&](std::uint32_t cell) {
      const int dc = std::abs(static_cast<int>(cell) % columns - goal_column);
      const int dr = std::abs(static_cast<int>(cell) / columns - goal_row);
      return static_cast<float>(std::max(dc, dr)) +
             (diagonal - 1) * static_cast<float>(std::min(dc, dr));
    };
    using Item = std::pair<float, std::uint32_t>;
    std::priority_queue<Item, std::vector<Item>, std::greater<>> open;
    std::vector<bool> is_closed(size);
    cost[start] = 0;
    open.emplace(rest(start), start);
    while (!open.empty()) {
      const auto cell = open.top().second;
      open.pop();
      if (is_closed[cell])
        continue;
      is_closed[cell] = true;
      if (cell == goal)
        break;
      for_neighbours(clearance_, cell, [&](std::uint32_t next, float length) {
        if (is_closed[next] || !fits(next) || cuts_corner(cell, next))
          return;
        const float reached = cost[cell] + length * static_cast<float>(rate(clearance_.at(next)));
        if (reached < cost[next]) {
          cost[next] = reached;
          from[next] = cell;
          open.emplace(reached + rest(next), next);
        }
      });
    }
    std::vector<std::uint32_t> result;
    if (!is_closed[goal])
      return result;
    for (auto cell = goal; cell != no_cell; cell = from[cell])
      result.push_back(cell);
    std::ranges::reverse(result);
    return result;
  }

  std::vector<Point2> points_of(const std::vector<std::uint32_t>& cells, const Point2& start,
                                const Point2& goal) const {
    std::vector<Point2> result{start};
    for (auto cell : cells)
      result.push_back(clearance_.centre(cell));
    result.push_back(goal);
    return result;
  }

  /// Cost of a straight way; infinite without enough clearance.
  double line_cost(const Point2& a, const Point2& b) const {
    const double length = distance(a, b);
    const int steps = std::max(1, static_cast<int>(2 * length / clearance_.cell_size()));
    double result = 0;
    for (int i = 0; i <= steps; ++i) {
      const double share = static_cast<double>(i) / steps;
      result += rate(Point2{std::lerp(a.x, b.x, share), std::lerp(a.y, b.y, share)});
    }
    return result / (steps + 1) * length;
  }

  /// The first piece leads from the start to a place with clearance, and stays as it is.
  std::vector<Point2> straightened(const std::vector<Point2>& path) const {
    std::vector<double> cost(path.size());
    for (std::size_t i = 1; i < path.size(); ++i) {
      const double piece = line_cost(path[i - 1], path[i]);
      cost[i] = cost[i - 1] + (std::isinf(piece) ? distance(path[i - 1], path[i]) : piece);
    }
    std::vector<Point2> result{path.front()};
    std::size_t i = 0;
    if (!fits(path[0]))
      result.push_back(path[i = 1]);
    while (i + 1 < path.size()) {
      std::size_t best = i + 1;
      // Not all: a longer one may be worth it where a shorter one is not, but rarely far on.
      constexpr std::size_t patience = 20;
      for (std::size_t j = i + 2; j < path.size() && j <= best + patience; ++j)
        if (line_cost(path[i], path[j]) <= (cost[j] - cost[i]) * (1 + 1e-9))
          best = j;
      result.push_back(path[best]);
      i = best;
    }
    return result;
  }

  /// Looks for the way whose narrowest place is widest, unknown cells included.
  std::string why_no_way(std::uint32_t start, std::uint32_t goal) const {
    auto cells = options_.cells;
    cells.unknown_is_obstacle = false;
    const ClearanceMap width(map_, cells);
    std::vector<float> widest(map_.cells.size(), -1);
    std::vector<std::uint32_t> narrowest(map_.cells.size(), no_cell);
    std::priority_queue<std::pair<float, std::uint32_t>> open;
    widest[start] = static_cast<float>(width.at(start));
    narrowest[start] = start;
    open.emplace(widest[start], start);
    while (!open.empty()) {
      const auto [reached, cell] = open.top();
      open.pop();
      if (cell == goal)
        break;
      if (reached < widest[cell])
        continue;
      for_neighbours(width, cell, [&, reached = reached, cell = cell](std::uint32_t next, float) {
        const auto here = static_cast<float>(width.at(next));
        const auto through = std::min(reached, here);
        if (here > 0 && through > widest[next]) {
          widest[next] = through;
          narrowest[next] = here < reached ? next : narrowest[cell];
          open.emplace(through, next);
        }
      });
    }
    if (!(widest[goal] > 0))
      return "no way: obstacles are all around the goal, or all around the robot";
    if (static_cast<double>(widest[goal]) >= needed_)
      return "no way is known: what is between is not explored yet";
    const auto at = width.centre(narrowest[goal]);
    return fmt::format("no way: the passage at ({:.2f}, {:.2f}) is {:.2f} m wide, the robot needs "
                       "{:.2f} m",
                       at.x, at.y, 2 * static_cast<double>(widest[goal]), 2 * needed_);
  }

  const CellMap& map_;
  const ClearanceMap& clearance_;
  const PlanOptions& options_;
  double needed_;
  Point2 start_;
  /// Whether less clearance is enough around the start.
  bool escapes_ = false;
};

} // namespace

PlannedPath plan_path(const CellMap& map, const ClearanceMap& clearance, const Point2& start,
                      const Point2& goal, const PlanOptions& options) {
  return Planner(map, clearance, options).plan(start, goal);
}

bool is_clear(const ClearanceMap& clearance, const Point2& a, const Point2& b, double least) {
  const int steps = std::max(1, static_cast<int>(2 * distance(a, b) / clearance.cell_size()));
  for (int i = 0; i <= steps; ++i) {
    const double share = static_cast<double>(i) / steps;
    if (clearance.at(Point2{std::lerp(a.x, b.x, share), std::lerp(a.y, b.y, share)}) < least)
      return false;
  }
  return true;
}

} // namespace castor::mapping
