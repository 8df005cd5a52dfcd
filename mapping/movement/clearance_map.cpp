#include "castor/mapping/movement/clearance_map.hpp"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace castor::mapping {

namespace {

/// From the distance of two cells' centres, in cells.
float clearance_of(float cells, double cell_size) {
  return std::max(0.0F, (cells - 0.5F) * static_cast<float>(cell_size));
}

} // namespace

ClearanceMap::ClearanceMap(const CellMap& map, const ClearanceOptions& options)
  : columns_(map.columns), rows_(map.rows),
    cell_size_(map.cell_size), origin_{map.origin.x, map.origin.y} {
  if (map.cells.empty())
    return;
  cv::Mat is_free(rows_, columns_, CV_8U);
  for (int row = 0; row < rows_; ++row)
    for (int column = 0; column < columns_; ++column) {
      const auto cell = map.at(column, row);
      const bool is_obstacle =
        cell < 0 ? options.unknown_is_obstacle : cell >= options.occupied_from;
      is_free.at<std::uint8_t>(row, column) = is_obstacle ? 0 : 1;
    }
  clearance_.resize(map.cells.size());
  cv::Mat distances(rows_, columns_, CV_32F, clearance_.data());
  cv::distanceTransform(is_free, distances, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  for (auto& x : clearance_)
    x = clearance_of(x, cell_size_);
}

void ClearanceMap::add_obstacle(const Point2& point, double reach, double around) {
  const auto cell = cell_at(point);
  if (!cell)
    return;
  const int middle_column = static_cast<int>(*cell) % columns_;
  const int middle_row = static_cast<int>(*cell) / columns_;
  const int most = static_cast<int>(std::ceil((reach + around) / cell_size_ + 0.5));
  for (int row = std::max(0, middle_row - most); row <= std::min(rows_ - 1, middle_row + most);
       ++row)
    for (int column = std::max(0, middle_column - most);
         column <= std::min(columns_ - 1, middle_column + most); ++column) {
      const auto away = std::hypot(static_cast<float>(column - middle_column),
                                   static_cast<float>(row - middle_row));
      auto& known = clearance_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                               static_cast<std::size_t>(column)];
      known =
        std::min(known, clearance_of(away - static_cast<float>(around / cell_size_), cell_size_));
    }
}

double ClearanceMap::at(const Point2& point) const {
  const auto cell = cell_at(point);
  return cell ? at(*cell) : 0;
}

double ClearanceMap::between_cells(const Point2& point) const {
  const double column = (point.x - origin_.x) / cell_size_ - 0.5;
  const double row = (point.y - origin_.y) / cell_size_ - 0.5;
  if (!(column >= 0 && row >= 0 && column < columns_ - 1 && row < rows_ - 1))
    return 0;
  const auto first = static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                     static_cast<std::size_t>(column);
  const auto above = first + static_cast<std::size_t>(columns_);
  const double right = column - std::floor(column);
  return std::lerp(std::lerp(at(first), at(first + 1), right),
                   std::lerp(at(above), at(above + 1), right), row - std::floor(row));
}

std::optional<std::size_t> ClearanceMap::cell_at(const Point2& point) const {
  const double column = std::floor((point.x - origin_.x) / cell_size_);
  const double row = std::floor((point.y - origin_.y) / cell_size_);
  if (!(column >= 0 && row >= 0 && column < columns_ && row < rows_))
    return std::nullopt;
  return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
         static_cast<std::size_t>(column);
}

Point2 ClearanceMap::centre(std::size_t cell) const {
  const auto columns = static_cast<std::size_t>(columns_);
  return {origin_.x + (static_cast<double>(cell % columns) + 0.5) * cell_size_,
          origin_.y + (static_cast<double>(cell / columns) + 0.5) * cell_size_};
}

} // namespace castor::mapping
