#include "castor/mapping/building/reachable_floor.hpp"

#include "castor/mapping/building/solid_obstacles.hpp"
#include "castor/mapping/building/solids.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace castor::mapping {

ReachableFloor::ReachableFloor(const Building& x, double radius, double cell) : cell_(cell) {
  const auto [low, high] = extent(x);
  low_ = low;
  columns_ = static_cast<int>(std::ceil((high.x - low.x) / cell));
  rows_ = static_cast<int>(std::ceil((high.y - low.y) / cell));
  const auto count = static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_);
  reachable_.resize(count);
  covered_.resize(count);
  const SolidObstacles obstacles(between_heights(solids_of(x), 0, checked_robot_height));
  const auto inside = [&](int column, int row) {
    return column >= 0 && row >= 0 && column < columns_ && row < rows_;
  };
  std::vector<std::uint8_t> looked_at(count);
  std::vector<std::pair<int, int>> waiting;
  const auto look_at = [&](int column, int row) {
    if (!inside(column, row) || std::exchange(looked_at[position(column, row)], 1) != 0)
      return;
    if (obstacles.clearance(centre(column, row), 2 * radius) < radius)
      return;
    reachable_[position(column, row)] = 1;
    waiting.emplace_back(column, row);
  };
  // The start itself need not be the centre of a cell.
  const int start_column = static_cast<int>(std::floor((x.start.x - low_.x) / cell_));
  const int start_row = static_cast<int>(std::floor((x.start.y - low_.y) / cell_));
  for (int row = start_row - 1; row <= start_row + 1; ++row)
    for (int column = start_column - 1; column <= start_column + 1; ++column)
      look_at(column, row);
  while (!waiting.empty()) {
    const auto [column, row] = waiting.back();
    waiting.pop_back();
    look_at(column + 1, row);
    look_at(column - 1, row);
    look_at(column, row + 1);
    look_at(column, row - 1);
  }
  const int reach = static_cast<int>(std::floor(radius / cell_));
  for (int row = 0; row < rows_; ++row)
    for (int column = 0; column < columns_; ++column) {
      if (!can_be_at(column, row))
        continue;
      for (int y = -reach; y <= reach; ++y)
        for (int z = -reach; z <= reach; ++z)
          if (std::hypot(y, z) * cell_ <= radius && inside(column + z, row + y))
            covered_[position(column + z, row + y)] = 1;
    }
}

Point2 ReachableFloor::centre(int column, int row) const {
  return {low_.x + (column + 0.5) * cell_, low_.y + (row + 0.5) * cell_};
}

std::size_t ReachableFloor::position(int column, int row) const {
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
         static_cast<std::size_t>(column);
}

bool ReachableFloor::can_be_at(const Point2& p) const {
  const int column = static_cast<int>(std::floor((p.x - low_.x) / cell_));
  const int row = static_cast<int>(std::floor((p.y - low_.y) / cell_));
  return column >= 0 && row >= 0 && column < columns_ && row < rows_ && can_be_at(column, row);
}

double ReachableFloor::covered_area() const {
  return static_cast<double>(std::ranges::count(covered_, 1)) * cell_ * cell_;
}

double ReachableFloor::area_in(const Building& x, const Room& room) const {
  double result = 0;
  for (int row = 0; row < rows_; ++row)
    for (int column = 0; column < columns_; ++column)
      if (can_be_at(column, row) && room_at(x, centre(column, row)) == &room)
        result += cell_ * cell_;
  return result;
}

} // namespace castor::mapping
