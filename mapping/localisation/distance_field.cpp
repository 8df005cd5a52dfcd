#include "castor/mapping/localisation/distance_field.hpp"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace castor::mapping {

namespace {

/// From the middle of each cell to that of the nearest occupied one, m.
std::vector<float> distances_in(const CellMap& map, int occupied_from) {
  cv::Mat others(map.rows, map.columns, CV_8U);
  for (int row = 0; row < map.rows; ++row)
    for (int column = 0; column < map.columns; ++column)
      others.at<std::uint8_t>(row, column) = map.at(column, row) >= occupied_from ? 0 : 1;
  cv::Mat distances;
  cv::distanceTransform(others, distances, cv::DIST_L2, cv::DIST_MASK_PRECISE, CV_32F);
  std::vector<float> result;
  result.reserve(map.cells.size());
  for (int row = 0; row < map.rows; ++row)
    for (int column = 0; column < map.columns; ++column)
      result.push_back(distances.at<float>(row, column) * static_cast<float>(map.cell_size));
  return result;
}

} // namespace

CellMap visible_surfaces(const CellMap& map, int occupied_from) {
  auto is_free = [&](int column, int row) {
    return column >= 0 && row >= 0 && column < map.columns && row < map.rows &&
           map.at(column, row) >= 0 && map.at(column, row) < occupied_from;
  };
  auto result = map;
  bool has_surface = false;
  for (int row = 0; row < map.rows; ++row)
    for (int column = 0; column < map.columns; ++column) {
      if (map.at(column, row) < occupied_from)
        continue;
      bool is_visible = false;
      for (int dx : {-1, 0, 1})
        for (int dy : {-1, 0, 1})
          is_visible = is_visible || is_free(column + dx, row + dy);
      if (!is_visible)
        result.at(column, row) = -1;
      has_surface = has_surface || is_visible;
    }
  return has_surface ? result : map;
}

DistanceField::DistanceField(const CellMap& map, int occupied_from)
  : columns_(map.columns), rows_(map.rows), cell_(map.cell_size), origin_(map.origin),
    to_occupied_(distances_in(map, occupied_from)),
    to_surface_(distances_in(visible_surfaces(map, occupied_from), occupied_from)) {
  is_free_.reserve(map.cells.size());
  for (auto cell : map.cells)
    is_free_.push_back(cell >= 0 && cell < occupied_from);
  free_area_ = static_cast<double>(std::ranges::count(is_free_, true)) * cell_ * cell_;
}

float DistanceField::at(const std::vector<float>& distances, double x, double y) const {
  constexpr float far = 1000;
  auto column = std::floor((x - origin_.x) / cell_);
  auto row = std::floor((y - origin_.y) / cell_);
  if (!(column >= 0 && row >= 0 && column < columns_ && row < rows_))
    return far;
  return distances[index(static_cast<int>(column), static_cast<int>(row))];
}

std::optional<DistanceField::Slope> DistanceField::slope(double x, double y) const {
  auto u = (x - origin_.x) / cell_ - 0.5;
  auto v = (y - origin_.y) / cell_ - 0.5;
  if (!(u >= 0 && v >= 0 && u < columns_ - 1 && v < rows_ - 1))
    return {};
  auto column = static_cast<int>(u);
  auto row = static_cast<int>(v);
  u -= column;
  v -= row;
  double a = to_surface_[index(column, row)];
  double b = to_surface_[index(column + 1, row)];
  double c = to_surface_[index(column, row + 1)];
  double d = to_surface_[index(column + 1, row + 1)];
  return Slope{(1 - v) * ((1 - u) * a + u * b) + v * ((1 - u) * c + u * d),
               ((1 - v) * (b - a) + v * (d - c)) / cell_,
               ((1 - u) * (c - a) + u * (d - b)) / cell_};
}

std::vector<Point2> DistanceField::free_places(double side, double clearance) const {
  std::vector<Point2> result;
  for (double y = side / 2; y < rows_ * cell_; y += side)
    for (double x = side / 2; x < columns_ * cell_; x += side) {
      auto place = index(static_cast<int>(x / cell_), static_cast<int>(y / cell_));
      if (is_free_[place] && to_occupied_[place] >= clearance)
        result.push_back({origin_.x + x, origin_.y + y});
    }
  return result;
}

} // namespace castor::mapping
