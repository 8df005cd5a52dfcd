#include "castor/mapping/localisation/distance_field.hpp"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace castor::mapping {

DistanceField::DistanceField(const CellMap& map, int occupied_from)
  : columns_(map.columns), rows_(map.rows), cell_(map.cell_size), origin_(map.origin) {
  cv::Mat others(rows_, columns_, CV_8U);
  std::size_t free = 0;
  is_free_.reserve(map.cells.size());
  for (int row = 0; row < rows_; ++row)
    for (int column = 0; column < columns_; ++column) {
      auto cell = map.at(column, row);
      others.at<std::uint8_t>(row, column) = cell >= occupied_from ? 0 : 1;
      is_free_.push_back(cell >= 0 && cell < occupied_from);
      free += is_free_.back() ? 1 : 0;
    }
  free_area_ = static_cast<double>(free) * cell_ * cell_;
  cv::Mat distances;
  cv::distanceTransform(others, distances, cv::DIST_L2, cv::DIST_MASK_PRECISE, CV_32F);
  distances_.reserve(map.cells.size());
  for (int row = 0; row < rows_; ++row)
    for (int column = 0; column < columns_; ++column)
      distances_.push_back(distances.at<float>(row, column) * static_cast<float>(cell_));
}

float DistanceField::at(double x, double y) const {
  constexpr float far = 1000;
  auto column = std::floor((x - origin_.x) / cell_);
  auto row = std::floor((y - origin_.y) / cell_);
  if (!(column >= 0 && row >= 0 && column < columns_ && row < rows_))
    return far;
  return distances_[index(static_cast<int>(column), static_cast<int>(row))];
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
  double a = distances_[index(column, row)];
  double b = distances_[index(column + 1, row)];
  double c = distances_[index(column, row + 1)];
  double d = distances_[index(column + 1, row + 1)];
  return Slope{(1 - v) * ((1 - u) * a + u * b) + v * ((1 - u) * c + u * d),
               ((1 - v) * (b - a) + v * (d - c)) / cell_,
               ((1 - u) * (c - a) + u * (d - b)) / cell_};
}

std::vector<Point2> DistanceField::free_places(double side, double clearance) const {
  std::vector<Point2> result;
  for (double y = side / 2; y < rows_ * cell_; y += side)
    for (double x = side / 2; x < columns_ * cell_; x += side) {
      auto place = index(static_cast<int>(x / cell_), static_cast<int>(y / cell_));
      if (is_free_[place] && distances_[place] >= clearance)
        result.push_back({origin_.x + x, origin_.y + y});
    }
  return result;
}

} // namespace castor::mapping
