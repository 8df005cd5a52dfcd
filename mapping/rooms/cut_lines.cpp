#include "castor/mapping/rooms/cut_lines.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <deque>
#include <map>
#include <numbers>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

namespace castor::mapping {

namespace {

/// A passage goes on as long as its clearance is between these shares of the neck's.
constexpr double narrower = 0.97;
constexpr double wider = 1.04;
/// It has ended where its clearance exceeds this share of the neck's.
constexpr double ended = 1.15;
/// Cells by which clearances vary on account of the raster.
constexpr double raster_error = 0.4;
/// Least cosine of the angle between a line's two halves, seen from the neck: some 135 degrees.
constexpr double straight_enough = -0.7;
/// Each round cuts a line between each two basins that still meet; few need more than three.
constexpr int most_rounds = 100;

struct Offset {
  double length = 0;
  int columns = 0;
  int rows = 0;
};

class Cutter {
public:
  Cutter(Basins& basins, const Raster<float>& clearance, double narrowest)
    : basins_(basins), labels_(basins.labels), clearance_(clearance), narrowest_(narrowest),
      open_(clearance.columns, clearance.rows, 0), used_(clearance.columns, clearance.rows, 0) {
    for (int i = 0; i < clearance.size(); ++i)
      open_[i] = clearance[i] > 0;
  }

  void run() {
    for (int round = 0; round < most_rounds; ++round) {
      auto necks = boundary_necks();
      if (necks.empty())
        break;
      for (auto& [pair, cell] : necks) {
        mark_used(cell);
        cut(neck_end(cell, greater(pair)));
      }
      reassign();
    }
    label_lines();
  }

private:
  using Pair = std::pair<std::int32_t, std::int32_t>;

  std::int32_t greater(const Pair& pair) const {
    auto peak = [&](auto x) { return basins_.basins[static_cast<std::size_t>(x)].clearance; };
    return peak(pair.first) > peak(pair.second) ? pair.first : pair.second;
  }

  /// For each two basins that meet, the widest place of their boundary that has not been cut.
  std::map<Pair, int> boundary_necks() const {
    std::map<Pair, int> result;
    for (int i = 0; i < clearance_.size(); ++i) {
      if (!open_[i] || used_[i] || clearance_[i] < narrowest_)
        continue;
      for (auto step : clearance_.beside()) {
        auto next = i + step;
        if (!open_[next] || labels_[next] == labels_[i])
          continue;
        auto& neck = result.try_emplace(std::minmax(labels_[i], labels_[next]), i).first->second;
        if (clearance_[i] > clearance_[neck])
          neck = i;
      }
    }
    return result;
  }

  /// A boundary is cut once near a place, whatever the outcome: so the rounds come to an end.
  void mark_used(int cell) {
    auto radius = static_cast<int>(clearance_[cell] / 2);
    auto column = clearance_.column(cell);
    auto row = clearance_.row(cell);
    for (int y = -radius; y <= radius; ++y)
      for (int x = -radius; x <= radius; ++x)
        if (x * x + y * y <= radius * radius && clearance_.holds(column + x, row + y))
          used_[clearance_.position(column + x, row + y)] = 1;
  }

  /// The end towards `basin` of the passage that the neck lies in; the neck if it is in none.
  int neck_end(int neck, std::int32_t basin) const {
    const double width = clearance_[neck];
    std::unordered_map<int, int> reached_from{{neck, neck}};
    std::deque<int> pending{neck};
    while (!pending.empty()) {
      auto cell = pending.front();
      pending.pop_front();
      for (auto step : clearance_.around()) {
        auto next = cell + step;
        if (!open_[next] || labels_[next] != basin || clearance_[next] < narrower * width ||
            !reached_from.try_emplace(next, cell).second)
          continue;
        if (clearance_[next] > ended * width + raster_error) {
          while (clearance_[cell] > wider * width + raster_error / 2 &&
                 reached_from.at(cell) != cell)
            cell = reached_from.at(cell);
          return cell;
        }
        pending.push_back(next);
      }
    }
    return neck;
  }

  /// Blocked cells around a cell, the nearest one first.
  std::vector<Offset> blocked_around(int cell) const {
    auto radius = 2 * static_cast<int>(std::ceil(clearance_[cell])) + 2;
    auto column = clearance_.column(cell);
    auto row = clearance_.row(cell);
    std::vector<Offset> result;
    for (int y = std::max(-radius, -1 - row); y <= std::min(radius, clearance_.rows - row); ++y)
      for (int x = std::max(-radius, -1 - column);
           x <= std::min(radius, clearance_.columns - column); ++x) {
        auto length = std::hypot(x, y);
        if (length <= radius && !(clearance_[clearance_.position(column + x, row + y)] > 0))
          result.push_back({length, x, y});
      }
    std::ranges::stable_sort(result, {}, &Offset::length);
    return result;
  }

  struct Line {
    Offset from;
    Offset to;
  };

  /// The shortest line between blocked cells that leads past the cell, and from its nearest one.
  std::optional<Line> shortest_line(int cell) const {
    const auto blocked = blocked_around(cell);
    if (blocked.empty())
      return std::nullopt;
    // Other cells are no farther than the nearest one but for the raster.
    const auto nearest_to = blocked.front().length + std::numbers::sqrt2;
    std::optional<Line> result;
    auto shortest = 0.;
    for (std::size_t i = 0; i < blocked.size() && blocked[i].length <= nearest_to; ++i)
      for (std::size_t j = i + 1; j < blocked.size(); ++j) {
        const auto& a = blocked[i];
        const auto& b = blocked[j];
        auto length = std::hypot(a.columns - b.columns, a.rows - b.rows);
        if ((result && length >= shortest) ||
            a.columns * b.columns + a.rows * b.rows > straight_enough * a.length * b.length)
          continue;
        shortest = length;
        result = Line{a, b};
      }
    return result;
  }

  /// Closes the cells of a line that no cell can be passed beside or diagonally.
  void cut(int cell) {
    auto line = shortest_line(cell);
    if (!line)
      return;
    auto column = clearance_.column(cell) + line->from.columns;
    auto row = clearance_.row(cell) + line->from.rows;
    auto right = line->to.columns - line->from.columns;
    auto up = line->to.rows - line->from.rows;
    auto columns = std::abs(right);
    auto rows = std::abs(up);
    open_[clearance_.position(column, row)] = 0;
    // One step to a side at a time, so that the line is connected beside.
    for (int x = 0, y = 0; x < columns || y < rows;) {
      if ((1 + 2 * x) * rows < (1 + 2 * y) * columns) {
        column += right > 0 ? 1 : -1;
        ++x;
      } else {
        row += up > 0 ? 1 : -1;
        ++y;
      }
      open_[clearance_.position(column, row)] = 0;
    }
  }

  /// Gives what is apart from the peak of its basin to the basins that it adjoins.
  void reassign() {
    std::vector<char> kept(static_cast<std::size_t>(clearance_.size()), 0);
    auto keep = [&](int x) { return std::exchange(kept[static_cast<std::size_t>(x)], 1) == 0; };
    std::deque<int> pending;
    for (const auto& x : basins_.basins)
      if (keep(x.peak))
        pending.push_back(x.peak);
    std::vector<int> all;
    while (!pending.empty()) {
      auto cell = pending.front();
      pending.pop_front();
      all.push_back(cell);
      for (auto step : clearance_.beside())
        if (auto next = cell + step; open_[next] && labels_[next] == labels_[cell] && keep(next))
          pending.push_back(next);
    }
    pending.assign(all.begin(), all.end());
    while (!pending.empty()) {
      auto cell = pending.front();
      pending.pop_front();
      for (auto step : clearance_.beside())
        if (auto next = cell + step; open_[next] && keep(next)) {
          labels_[next] = labels_[cell];
          pending.push_back(next);
        }
    }
  }

  /// The free cells of the lines belong to a basin beside them.
  void label_lines() {
    for (int i = 0; i < clearance_.size(); ++i) {
      if (open_[i] || !(clearance_[i] > 0))
        continue;
      for (auto step : clearance_.beside())
        if (open_[i + step]) {
          labels_[i] = labels_[i + step];
          break;
        }
    }
  }

  Basins& basins_;
  Raster<std::int32_t>& labels_;
  const Raster<float>& clearance_;
  double narrowest_;
  /// Cells that are free and not on a line.
  Raster<char> open_;
  /// Cells near which a line has been cut.
  Raster<char> used_;
};

} // namespace

void straighten(Basins& basins, const Raster<float>& clearance, double narrowest_neck) {
  Cutter(basins, clearance, narrowest_neck).run();
}

} // namespace castor::mapping
