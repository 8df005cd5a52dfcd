#include "castor/mapping/slam/point_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace castor::mapping {

namespace {

constexpr double smallest_cell = 0.1;
constexpr double most_cells_of_map = 1 << 20;

} // namespace

PointMap::PointMap(const SurfacePoints& points) {
  auto right = -std::numeric_limits<double>::infinity();
  auto top = right;
  left_ = bottom_ = -right;
  for (const auto& x : points) {
    if (!x.has_normal() || !std::isfinite(x.position.x) || !std::isfinite(x.position.y))
      continue;
    points_.push_back(x);
    left_ = std::min(left_, x.position.x);
    right = std::max(right, x.position.x);
    bottom_ = std::min(bottom_, x.position.y);
    top = std::max(top, x.position.y);
  }
  if (points_.empty())
    return;
  cell_ = std::max(smallest_cell, std::sqrt((right - left_) * (top - bottom_) / most_cells_of_map));
  columns_ = static_cast<std::int64_t>((right - left_) / cell_) + 1;
  rows_ = static_cast<std::int64_t>((top - bottom_) / cell_) + 1;
  auto cell_of = [&](const SurfacePoint& x) {
    return static_cast<std::size_t>(row_of(x.position.y) * columns_ + column_of(x.position.x));
  };
  first_.assign(static_cast<std::size_t>(columns_ * rows_) + 1, 0);
  for (const auto& x : points_)
    ++first_[cell_of(x) + 1];
  for (std::size_t i = 1; i < first_.size(); ++i)
    first_[i] += first_[i - 1];
  SurfacePoints sorted(points_.size());
  auto next = first_;
  for (const auto& x : points_)
    sorted[next[cell_of(x)]++] = x;
  points_ = std::move(sorted);
}

std::int64_t PointMap::column_of(double x) const {
  return static_cast<std::int64_t>(std::floor((x - left_) / cell_));
}

std::int64_t PointMap::row_of(double y) const {
  return static_cast<std::int64_t>(std::floor((y - bottom_) / cell_));
}

const SurfacePoint* PointMap::nearest(const SurfacePoint& like, double most) const {
  if (points_.empty())
    return nullptr;
  const SurfacePoint* result = nullptr;
  auto best = most * most;
  auto any_way = !like.has_normal();
  auto first_column = std::max<std::int64_t>(column_of(like.position.x - most), 0);
  auto last_column = std::min(column_of(like.position.x + most), columns_ - 1);
  auto first_row = std::max<std::int64_t>(row_of(like.position.y - most), 0);
  auto last_row = std::min(row_of(like.position.y + most), rows_ - 1);
  for (auto row = first_row; row <= last_row && first_column <= last_column; ++row) {
    // The cells of a row are next to each other.
    auto begin = first_[static_cast<std::size_t>(row * columns_ + first_column)];
    auto end = first_[static_cast<std::size_t>(row * columns_ + last_column) + 1];
    for (auto i = begin; i < end; ++i) {
      const auto& x = points_[i];
      auto dx = x.position.x - like.position.x;
      auto dy = x.position.y - like.position.y;
      auto squared = dx * dx + dy * dy;
      if (squared >= best)
        continue;
      if (!any_way && x.normal.x * like.normal.x + x.normal.y * like.normal.y < 0.5)
        continue;
      best = squared;
      result = &x;
    }
  }
  return result;
}

} // namespace castor::mapping
