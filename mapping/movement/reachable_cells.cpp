#include "castor/mapping/movement/reachable_cells.hpp"

#include <opencv2/imgproc.hpp>

#include <cmath>

namespace castor::mapping {

namespace {

/// Cells within which an obstacle's centre is nearer than that.
cv::Mat disc(double clearance, double cell_size) {
  // The edge of an obstacle is half a cell from its centre.
  const double cells = clearance / cell_size + 0.5;
  const int reach = static_cast<int>(std::floor(cells));
  cv::Mat result(2 * reach + 1, 2 * reach + 1, CV_8U);
  for (int row = -reach; row <= reach; ++row)
    for (int column = -reach; column <= reach; ++column)
      result.at<std::uint8_t>(row + reach, column + reach) =
        std::hypot(row, column) < cells ? 1 : 0;
  return result;
}

} // namespace

ReachableCells::ReachableCells(const CellMap& map, const Point2& start, double clearance,
                               double start_tolerance, int occupied_from)
  : columns_(map.columns), rows_(map.rows),
    cell_size_(map.cell_size), origin_{map.origin.x, map.origin.y}, reachable_(map.cells.size()) {
  if (map.cells.empty())
    return;
  cv::Mat obstacles(rows_, columns_, CV_8U);
  for (int row = 0; row < rows_; ++row)
    for (int column = 0; column < columns_; ++column) {
      const auto cell = map.at(column, row);
      obstacles.at<std::uint8_t>(row, column) = cell < 0 || cell >= occupied_from ? 1 : 0;
    }
  cv::dilate(obstacles, obstacles, disc(clearance, cell_size_), {-1, -1}, 1, cv::BORDER_CONSTANT,
             cv::Scalar(1));
  cv::Mat parts;
  cv::connectedComponents(1 - obstacles, parts, 4, CV_32S);
  int part = 0;
  double nearest = start_tolerance;
  for (int row = 0; row < rows_; ++row)
    for (int column = 0; column < columns_; ++column) {
      const Point2 centre{origin_.x + (column + 0.5) * cell_size_,
                          origin_.y + (row + 0.5) * cell_size_};
      if (parts.at<int>(row, column) == 0 || distance(centre, start) > nearest)
        continue;
      nearest = distance(centre, start);
      part = parts.at<int>(row, column);
    }
  if (part == 0)
    return;
  for (int row = 0; row < rows_; ++row)
    for (int column = 0; column < columns_; ++column)
      reachable_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                 static_cast<std::size_t>(column)] = parts.at<int>(row, column) == part ? 1 : 0;
}

bool ReachableCells::can_be_at(const Point2& p) const {
  const double column = std::floor((p.x - origin_.x) / cell_size_);
  const double row = std::floor((p.y - origin_.y) / cell_size_);
  return column >= 0 && row >= 0 && column < columns_ && row < rows_ &&
         reachable_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                    static_cast<std::size_t>(column)] != 0;
}

} // namespace castor::mapping
