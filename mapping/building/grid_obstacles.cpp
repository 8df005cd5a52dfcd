#include "castor/mapping/building/grid_obstacles.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

namespace castor::mapping {

GridObstacles::GridObstacles(std::vector<std::uint8_t> occupied, std::int64_t columns,
                             std::int64_t rows, double cell, const Point2& low)
  : occupied_(std::move(occupied)), columns_(columns), rows_(rows), cell_(cell), low_(low) {
  if (columns <= 0 || rows <= 0 || !(cell > 0) ||
      occupied_.size() != static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows))
    throw std::invalid_argument("a grid of obstacles needs columns * rows cells of positive size");
}

bool GridObstacles::is_occupied(std::int64_t column, std::int64_t row) const {
  return column >= 0 && column < columns_ && row >= 0 && row < rows_ &&
         occupied_[static_cast<std::size_t>(row * columns_ + column)] != 0;
}

std::optional<double> GridObstacles::cast(const Point2& origin, double direction,
                                          double max_range) const {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const double ux = std::cos(direction);
  const double uy = std::sin(direction);
  // In cells, from cell to cell (J. Amanatides and A. Woo, "A fast voxel traversal algorithm for
  // ray tracing", 1987).
  const double x = (origin.x - low_.x) / cell_;
  const double y = (origin.y - low_.y) / cell_;
  auto column = static_cast<std::int64_t>(std::floor(x));
  auto row = static_cast<std::int64_t>(std::floor(y));
  const double step_x = ux == 0 ? infinity : 1 / std::abs(ux);
  const double step_y = uy == 0 ? infinity : 1 / std::abs(uy);
  double next_x = ux == 0  ? infinity
                  : ux > 0 ? (static_cast<double>(column + 1) - x) * step_x
                           : (x - static_cast<double>(column)) * step_x;
  double next_y = uy == 0  ? infinity
                  : uy > 0 ? (static_cast<double>(row + 1) - y) * step_y
                           : (y - static_cast<double>(row)) * step_y;
  double at = 0;
  const double end = max_range / cell_;
  while (at <= end) {
    if (is_occupied(column, row))
      return at * cell_;
    // Out of the grid, and not on the way into it.
    if ((ux >= 0 && column >= columns_) || (ux <= 0 && column < 0) || (uy >= 0 && row >= rows_) ||
        (uy <= 0 && row < 0))
      return std::nullopt;
    if (next_x < next_y) {
      at = next_x;
      next_x += step_x;
      column += ux > 0 ? 1 : -1;
    } else {
      at = next_y;
      next_y += step_y;
      row += uy > 0 ? 1 : -1;
    }
  }
  return std::nullopt;
}

double GridObstacles::clearance(const Point2& p, double limit) const {
  double result = limit;
  auto index = [&](double from, double to) {
    return static_cast<std::int64_t>(std::floor((to - from) / cell_));
  };
  const auto last_row = std::min(rows_ - 1, index(low_.y, p.y + limit));
  const auto last_column = std::min(columns_ - 1, index(low_.x, p.x + limit));
  for (auto row = std::max<std::int64_t>(0, index(low_.y, p.y - limit)); row <= last_row; ++row)
    for (auto column = std::max<std::int64_t>(0, index(low_.x, p.x - limit)); column <= last_column;
         ++column) {
      if (!is_occupied(column, row))
        continue;
      const double left = low_.x + static_cast<double>(column) * cell_;
      const double bottom = low_.y + static_cast<double>(row) * cell_;
      result = std::min(result, std::hypot(std::max({0.0, left - p.x, p.x - left - cell_}),
                                           std::max({0.0, bottom - p.y, p.y - bottom - cell_})));
    }
  return result;
}

} // namespace castor::mapping
