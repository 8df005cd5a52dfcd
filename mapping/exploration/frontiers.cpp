#include "castor/mapping/exploration/frontiers.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <utility>

namespace castor::mapping {

namespace {

double between_cells(const Cell& a, const Cell& b) {
  return std::hypot(a.column - b.column, a.row - b.row);
}

class FrontierSearch {
public:
  FrontierSearch(const CellMap& map, const FreeFloor& floor, const FrontierOptions& options)
    : map_(map), floor_(floor), options_(options) {
    // nop
  }

  std::vector<Frontier> run() {
    std::vector<Frontier> result;
    auto [sought, others] = borders();
    for (const auto& cells : clusters(std::move(sought)))
      if (is_large(cells))
        result.push_back(frontier_of(cells));
    for (const auto& cells : clusters(std::move(others)))
      if (is_large(cells))
        result.push_back(needless(cells));
    return result;
  }

private:
  /// Unknown floor that the robot may come to cover: what is to be seen.
  bool is_sought(const Cell& x) const { return floor_.is_unknown(x) && floor_.may_cover(x); }

  template <class F>
  bool is_beside(const Cell& x, F is_wanted) const {
    return is_wanted(Cell{x.column + 1, x.row}) || is_wanted(Cell{x.column - 1, x.row}) ||
           is_wanted(Cell{x.column, x.row + 1}) || is_wanted(Cell{x.column, x.row - 1});
  }

  struct Borders {
    /// Beside what is sought, and beside other unknown cells only.
    std::set<Cell> sought;
    std::set<Cell> others;
  };

  Borders borders() const {
    Borders result;
    for (int row = 0; row < map_.rows; ++row)
      for (int column = 0; column < map_.columns; ++column) {
        const Cell x{column, row};
        if (!floor_.is_free(x))
          continue;
        if (is_beside(x, [&](const Cell& y) { return is_sought(y); }))
          result.sought.insert(x);
        else if (is_beside(x, [&](const Cell& y) { return floor_.is_unknown(y); }))
          result.others.insert(x);
      }
    return result;
  }

  std::vector<std::vector<Cell>> clusters(std::set<Cell> borders) const {
    std::vector<std::vector<Cell>> result;
    while (!borders.empty()) {
      std::vector<Cell> cluster{*borders.begin()};
      borders.erase(borders.begin());
      for (std::size_t i = 0; i < cluster.size(); ++i)
        for (int y = -1; y <= 1; ++y)
          for (int x = -1; x <= 1; ++x)
            if (auto next = borders.extract(Cell{cluster[i].column + x, cluster[i].row + y}))
              cluster.push_back(next.value());
      for (auto& part : divided(std::move(cluster)))
        result.push_back(std::move(part));
    }
    return result;
  }

  /// A long frontier is looked at from several places.
  std::vector<std::vector<Cell>> divided(std::vector<Cell> cluster) const {
    const double most = 2 * options_.view_distance / map_.cell_size;
    std::vector<std::vector<Cell>> result;
    while (!cluster.empty()) {
      const auto seed = cluster.front();
      const auto far = std::ranges::partition(
        cluster, [&](const Cell& x) { return between_cells(x, seed) <= most; });
      result.emplace_back(cluster.begin(), far.begin());
      cluster.erase(cluster.begin(), far.begin());
    }
    return result;
  }

  bool is_large(const std::vector<Cell>& cells) const {
    return static_cast<double>(cells.size()) * map_.cell_size >= options_.least_size;
  }

  Cell middle_of(const std::vector<Cell>& cells) const {
    double column = 0;
    double row = 0;
    for (const auto& x : cells) {
      column += x.column;
      row += x.row;
    }
    column /= static_cast<double>(cells.size());
    row /= static_cast<double>(cells.size());
    return *std::ranges::min_element(
      cells, {}, [&](const Cell& x) { return std::hypot(x.column - column, x.row - row); });
  }

  Frontier without_view(const std::vector<Cell>& cells, const Cell& middle) const {
    Frontier result;
    result.middle = floor_.centre(middle);
    result.size = static_cast<double>(cells.size()) * map_.cell_size;
    result.reason = floor_.is_connected(middle) ? "the way there is too narrow for the robot"
                                                : "no free way leads there from where the robot is";
    return result;
  }

  /// Nothing behind it is sought.
  Frontier needless(const std::vector<Cell>& cells) const {
    const auto middle = middle_of(cells);
    auto result = without_view(cells, middle);
    if (floor_.may_cover(middle))
      result.reason = "the robot does not fit into what is behind it";
    return result;
  }

  Frontier frontier_of(const std::vector<Cell>& cells) const {
    const auto middle = middle_of(cells);
    auto result = without_view(cells, middle);
    const auto [view, target] = view_of(cells, middle);
    if (!floor_.contains(view))
      return result;
    const auto from = floor_.centre(view);
    result.is_reachable = true;
    result.reason.clear();
    result.view = {from.x, from.y, heading_to_unknown(from, target)};
    result.cost = floor_.way_to(view);
    result.gain = seen_from(view);
    return result;
  }

  /// To the middle of what is unknown around a cell of the frontier.
  double heading_to_unknown(const Point2& from, const Cell& target) const {
    constexpr int around = 6;
    Point2 sum;
    for (int y = -around; y <= around; ++y)
      for (int x = -around; x <= around; ++x) {
        const Cell cell{target.column + x, target.row + y};
        if (!floor_.is_unknown(cell))
          continue;
        const auto p = floor_.centre(cell);
        sum = {sum.x + p.x - from.x, sum.y + p.y - from.y};
      }
    return std::atan2(sum.y, sum.x);
  }

  /// Where the robot can stand and sees a cell of the frontier, the one nearest to the robot's way,
  /// and that cell; outside of the map if there is none.
  std::pair<Cell, Cell> view_of(const std::vector<Cell>& cells, const Cell& middle) const {
    if (auto view = view_on(middle); floor_.contains(view))
      return {view, middle};
    // Some of the others, spread over the frontier.
    constexpr std::size_t most = 8;
    const auto step = std::max<std::size_t>(1, cells.size() / most);
    for (std::size_t i = 0; i < cells.size(); i += step)
      if (auto view = view_on(cells[i]); floor_.contains(view))
        return {view, cells[i]};
    return {{-1, -1}, middle};
  }

  Cell view_on(const Cell& target) const {
    const int reach = static_cast<int>(options_.view_distance / map_.cell_size);
    Cell result{-1, -1};
    double best = std::numeric_limits<double>::infinity();
    for (int y = -reach; y <= reach; ++y)
      for (int x = -reach; x <= reach; ++x) {
        const Cell cell{target.column + x, target.row + y};
        const double away = std::hypot(x, y);
        // The way counts less: from near, more is seen around corners.
        const double worth =
          std::abs(away * map_.cell_size - options_.best_view_distance) + 0.2 * floor_.way_to(cell);
        if (away <= reach && worth < best && floor_.sees(cell, target)) {
          best = worth;
          result = cell;
        }
      }
    return result;
  }

  /// Rays through what is not occupied.
  double seen_from(const Cell& view) const {
    constexpr int rays = 90;
    double result = 0;
    const int steps = static_cast<int>(options_.sight / map_.cell_size);
    for (int i = 0; i < rays; ++i) {
      const double angle = 2 * std::numbers::pi * i / rays;
      for (int step = 1; step <= steps; ++step) {
        const Cell cell{view.column + static_cast<int>(std::lround(step * std::cos(angle))),
                        view.row + static_cast<int>(std::lround(step * std::sin(angle)))};
        if (floor_.is_blocked(cell))
          break;
        if (is_sought(cell))
          result += step;
      }
    }
    // A piece of a ray stands for the part of the circle between it and the next one.
    return result * map_.cell_size * map_.cell_size * 2 * std::numbers::pi / rays;
  }

  const CellMap& map_;
  const FreeFloor& floor_;
  const FrontierOptions& options_;
};

} // namespace

std::vector<Frontier> find_frontiers(const CellMap& map, const FreeFloor& floor,
                                     const FrontierOptions& options) {
  return FrontierSearch(map, floor, options).run();
}

} // namespace castor::mapping
