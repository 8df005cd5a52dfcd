#include "castor/mapping/exploration/free_floor.hpp"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <queue>
#include <utility>

namespace castor::mapping {

namespace {

constexpr float no_way = std::numeric_limits<float>::infinity();
constexpr std::array<Cell, 8> neighbours{
  {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {1, -1}, {-1, 1}, {-1, -1}}};

Cell operator+(const Cell& a, const Cell& b) {
  return {a.column + b.column, a.row + b.row};
}

} // namespace

FreeFloor::FreeFloor(const CellMap& map, const Pose2& robot, const Options& options)
  : map_(map), options_(options) {
  const auto count = static_cast<std::size_t>(map.columns) * static_cast<std::size_t>(map.rows);
  standable_.resize(count);
  connected_.resize(count);
  ways_.resize(count, no_way);
  coverable_.resize(count);
  if (count == 0)
    return;
  const auto distances = distances_from_blocked();
  find_standable(distances);
  const auto start = start_of(cell_at({robot.x, robot.y}));
  if (!contains(start))
    return;
  find_ways(start);
  find_connected(start);
  find_coverable(distances, start);
}

std::vector<float> FreeFloor::distances_from_blocked() const {
  cv::Mat open(map_.rows, map_.columns, CV_8U);
  for (int row = 0; row < map_.rows; ++row)
    for (int column = 0; column < map_.columns; ++column)
      open.at<std::uint8_t>(row, column) = is_blocked({column, row}) ? 0 : 1;
  std::vector<float> result(standable_.size());
  cv::Mat distances(map_.rows, map_.columns, CV_32F, result.data());
  cv::distanceTransform(open, distances, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  return result;
}

void FreeFloor::find_standable(const std::vector<float>& distances) {
  const auto least = static_cast<float>(options_.clearance / map_.cell_size);
  for (int row = 0; row < map_.rows; ++row)
    for (int column = 0; column < map_.columns; ++column)
      standable_[position({column, row})] =
        is_free({column, row}) && distances[position({column, row})] >= least;
}

void FreeFloor::find_coverable(const std::vector<float>& distances, const Cell& start) {
  // One cell more, since what is in the way may be anywhere within its cell.
  const auto least = static_cast<float>(options_.radius / map_.cell_size + 1);
  // 0 where the robot's middle may be, as a distance transform takes it.
  cv::Mat elsewhere(map_.rows, map_.columns, CV_8U, cv::Scalar(1));
  std::vector<Cell> waiting{start};
  elsewhere.at<std::uint8_t>(start.row, start.column) = 0;
  while (!waiting.empty()) {
    const auto cell = waiting.back();
    waiting.pop_back();
    for (std::size_t i = 0; i < 4; ++i) {
      const auto next = cell + neighbours[i];
      if (contains(next) && distances[position(next)] >= least &&
          std::exchange(elsewhere.at<std::uint8_t>(next.row, next.column), std::uint8_t{0}) != 0)
        waiting.push_back(next);
    }
  }
  cv::Mat away;
  cv::distanceTransform(elsewhere, away, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  const auto reach = static_cast<float>(options_.radius / map_.cell_size);
  for (int row = 0; row < map_.rows; ++row)
    for (int column = 0; column < map_.columns; ++column)
      coverable_[position({column, row})] = away.at<float>(row, column) <= reach;
}

/// Outside of the map if there is none.
Cell FreeFloor::start_of(const Cell& robot) const {
  const int reach = static_cast<int>(options_.greatest_start_distance / map_.cell_size);
  Cell result{-1, -1};
  double nearest = std::numeric_limits<double>::infinity();
  for (int y = -reach; y <= reach; ++y)
    for (int x = -reach; x <= reach; ++x) {
      const auto cell = robot + Cell{x, y};
      const double away = std::hypot(x, y);
      if (away > reach || away >= nearest || !contains(cell) || standable_[position(cell)] == 0)
        continue;
      nearest = away;
      result = cell;
    }
  return result;
}

void FreeFloor::find_ways(const Cell& start) {
  using Item = std::pair<float, Cell>;
  std::priority_queue<Item, std::vector<Item>, std::greater<>> waiting;
  ways_[position(start)] = 0;
  waiting.emplace(0.F, start);
  while (!waiting.empty()) {
    const auto [way, cell] = waiting.top();
    waiting.pop();
    if (way > ways_[position(cell)])
      continue;
    for (const auto& step : neighbours) {
      const auto next = cell + step;
      if (!contains(next) || standable_[position(next)] == 0)
        continue;
      const bool is_diagonal = step.column != 0 && step.row != 0;
      const float longer =
        way + static_cast<float>(map_.cell_size * (is_diagonal ? std::numbers::sqrt2 : 1));
      if (longer < ways_[position(next)]) {
        ways_[position(next)] = longer;
        waiting.emplace(longer, next);
      }
    }
  }
}

void FreeFloor::find_connected(const Cell& start) {
  std::vector<Cell> waiting{start};
  connected_[position(start)] = 1;
  while (!waiting.empty()) {
    const auto cell = waiting.back();
    waiting.pop_back();
    for (std::size_t i = 0; i < 4; ++i) {
      const auto next = cell + neighbours[i];
      if (is_free(next) && std::exchange(connected_[position(next)], std::uint8_t{1}) == 0)
        waiting.push_back(next);
    }
  }
}

double FreeFloor::way_to(const Cell& x) const {
  return contains(x) ? ways_[position(x)] : no_way;
}

bool FreeFloor::is_connected(const Cell& x) const {
  return contains(x) && connected_[position(x)] != 0;
}

bool FreeFloor::sees(const Cell& from, const Cell& to) const {
  const int steps = std::max(std::abs(to.column - from.column), std::abs(to.row - from.row));
  for (int i = 0; i < steps; ++i) {
    const double share = static_cast<double>(i) / steps;
    const Cell cell{from.column + static_cast<int>(std::lround(share * (to.column - from.column))),
                    from.row + static_cast<int>(std::lround(share * (to.row - from.row)))};
    if (!is_free(cell))
      return false;
  }
  return !is_blocked(to);
}

Cell FreeFloor::cell_at(const Point2& p) const {
  const auto local = between(map_.origin, {p.x, p.y, 0});
  return cell_of({local.x, local.y}, map_.cell_size);
}

Point2 FreeFloor::centre(const Cell& x) const {
  return transform(map_.origin, centre_of(x, map_.cell_size));
}

double FreeFloor::area() const {
  const auto count = std::ranges::count_if(
    map_.cells, [&](auto cell) { return cell >= 0 && cell <= options_.free_at_most; });
  return static_cast<double>(count) * map_.cell_size * map_.cell_size;
}

} // namespace castor::mapping
