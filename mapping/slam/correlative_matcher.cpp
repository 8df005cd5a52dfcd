#include "castor/mapping/slam/correlative_matcher.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <utility>

namespace castor::mapping {

namespace {

constexpr std::size_t level_count = 6;
constexpr std::int64_t most_cells_of_grid = 4'000'000;

std::int64_t floored(double x) {
  return static_cast<std::int64_t>(std::floor(x));
}

} // namespace

/// The cells of the scan's points at one heading.
struct CorrelativeMatcher::Turn {
  double heading = 0;
  std::vector<std::pair<std::int64_t, std::int64_t>> cells;
};

/// A square of translations at one heading.
struct CorrelativeMatcher::Node {
  double score = 0;
  std::size_t level = 0;
  std::size_t turn = 0;
  std::int64_t dx = 0;
  std::int64_t dy = 0;

  friend bool operator<(const Node& a, const Node& b) {
    // Finer squares first among equals, so that the search ends soon.
    return std::pair{a.score, b.level} < std::pair{b.score, a.level};
  }
};

CorrelativeMatcher::CorrelativeMatcher(const SurfacePoints& map, const CorrelativeOptions& options)
  : options_(options) {
  make_finest(map);
  while (!levels_.empty() && levels_.size() < level_count)
    make_coarser();
}

void CorrelativeMatcher::make_finest(const SurfacePoints& map) {
  if (map.empty())
    return;
  auto right = -std::numeric_limits<double>::infinity();
  auto top = right;
  left_ = bottom_ = -right;
  for (const auto& x : map) {
    left_ = std::min(left_, x.position.x);
    right = std::max(right, x.position.x);
    bottom_ = std::min(bottom_, x.position.y);
    top = std::max(top, x.position.y);
  }
  auto cell = options_.cell;
  auto reach = static_cast<std::int64_t>(std::ceil(3 * options_.spread / cell));
  left_ -= static_cast<double>(reach) * cell;
  bottom_ -= static_cast<double>(reach) * cell;
  Level finest;
  finest.columns = floored((right - left_) / cell) + reach + 1;
  finest.rows = floored((top - bottom_) / cell) + reach + 1;
  if (finest.columns * finest.rows > most_cells_of_grid)
    return;
  finest.cells.resize(static_cast<std::size_t>(finest.columns * finest.rows));
  for (const auto& x : map) {
    auto column = floored((x.position.x - left_) / cell);
    auto row = floored((x.position.y - bottom_) / cell);
    for (auto r = row - reach; r <= row + reach; ++r)
      for (auto c = column - reach; c <= column + reach; ++c) {
        if (c < 0 || r < 0 || c >= finest.columns || r >= finest.rows)
          continue;
        auto dx = left_ + (static_cast<double>(c) + 0.5) * cell - x.position.x;
        auto dy = bottom_ + (static_cast<double>(r) + 0.5) * cell - x.position.y;
        auto fit = std::exp(-(dx * dx + dy * dy) / (2 * options_.spread * options_.spread));
        auto& value = finest.cells[static_cast<std::size_t>(r * finest.columns + c)];
        value = std::max(value, static_cast<std::uint8_t>(std::lround(255 * fit)));
      }
  }
  levels_.push_back(std::move(finest));
}

void CorrelativeMatcher::make_coarser() {
  const auto& finer = levels_.back();
  auto step = std::int64_t{1} << (levels_.size() - 1);
  Level result;
  result.margin = finer.margin + step;
  result.columns = finer.columns + step;
  result.rows = finer.rows + step;
  result.cells.resize(static_cast<std::size_t>(result.columns * result.rows));
  for (std::int64_t row = 0; row < result.rows; ++row)
    for (std::int64_t column = 0; column < result.columns; ++column) {
      auto c = column - result.margin;
      auto r = row - result.margin;
      result.cells[static_cast<std::size_t>(row * result.columns + column)] =
        std::max({finer.at(c, r), finer.at(c + step, r), finer.at(c, r + step),
                  finer.at(c + step, r + step)});
    }
  levels_.push_back(std::move(result));
}

double CorrelativeMatcher::score_of(const Turn& turn, std::int64_t dx, std::int64_t dy,
                                    std::size_t level) const {
  const auto& grid = levels_[level];
  std::int64_t sum = 0;
  for (const auto& [column, row] : turn.cells)
    sum += grid.at(column + dx, row + dy);
  return static_cast<double>(sum) / (255. * static_cast<double>(turn.cells.size()));
}

std::optional<CorrelativeMatch> CorrelativeMatcher::match(const SurfacePoints& scan,
                                                          const Pose2& middle,
                                                          const SearchWindow& window,
                                                          double least) const {
  if (levels_.empty() || scan.empty())
    return {};
  auto cell = options_.cell;
  auto heading_step = cell / options_.heading_range;
  auto turns_each_side = static_cast<std::int64_t>(std::ceil(window.heading / heading_step));
  auto reach = static_cast<std::int64_t>(std::ceil(window.translation / cell));
  std::vector<Turn> turns;
  for (auto i = -turns_each_side; i <= turns_each_side; ++i) {
    Turn turn{middle.heading + static_cast<double>(i) * heading_step, {}};
    auto c = std::cos(turn.heading);
    auto s = std::sin(turn.heading);
    for (const auto& x : scan)
      turn.cells.emplace_back(
        floored((middle.x + c * x.position.x - s * x.position.y - left_) / cell),
        floored((middle.y + s * x.position.x + c * x.position.y - bottom_) / cell));
    turns.push_back(std::move(turn));
  }
  auto top = levels_.size() - 1;
  auto stride = std::int64_t{1} << top;
  std::priority_queue<Node> open;
  auto push = [&](Node node) {
    node.score = score_of(turns[node.turn], node.dx, node.dy, node.level);
    if (node.score >= least)
      open.push(node);
  };
  for (std::size_t t = 0; t < turns.size(); ++t)
    for (auto dx = -reach; dx <= reach; dx += stride)
      for (auto dy = -reach; dy <= reach; dy += stride)
        push({0, top, t, dx, dy});
  while (!open.empty()) {
    auto node = open.top();
    open.pop();
    if (node.level == 0)
      return CorrelativeMatch{{middle.x + static_cast<double>(node.dx) * cell,
                               middle.y + static_cast<double>(node.dy) * cell,
                               normalised(turns[node.turn].heading)},
                              node.score};
    auto half = std::int64_t{1} << (node.level - 1);
    for (auto dx : {node.dx, node.dx + half})
      for (auto dy : {node.dy, node.dy + half})
        if (dx <= reach && dy <= reach)
          push({0, node.level - 1, node.turn, dx, dy});
  }
  return {};
}

} // namespace castor::mapping
