#include "castor/mapping/localisation/map_fit.hpp"

#include "castor/mapping/planar/poses.hpp"

#include <opencv2/imgproc.hpp>

#include <algorithm>
#include <cmath>

namespace castor::mapping {

MapFit::MapFit(const CellMap& map, const MapFitOptions& options)
  : options_(options), columns_(map.columns), rows_(map.rows), cell_(map.cell_size),
    origin_(map.origin) {
  cv::Mat others(rows_, columns_, CV_8U);
  std::size_t free = 0;
  for (int row = 0; row < rows_; ++row)
    for (int column = 0; column < columns_; ++column) {
      auto cell = map.at(column, row);
      others.at<std::uint8_t>(row, column) = cell >= options.occupied_from ? 0 : 1;
      free += cell >= 0 && cell < options.occupied_from ? 1 : 0;
    }
  free_area_ = static_cast<double>(free) * cell_ * cell_;
  cv::Mat distances;
  cv::distanceTransform(others, distances, cv::DIST_L2, cv::DIST_MASK_PRECISE, CV_32F);
  distances_.reserve(map.cells.size());
  for (int row = 0; row < rows_; ++row)
    for (int column = 0; column < columns_; ++column)
      distances_.push_back(distances.at<float>(row, column) * static_cast<float>(cell_));
}

float MapFit::distance_at(double x, double y) const {
  constexpr float far = 1e6F;
  auto column = std::floor(x / cell_);
  auto row = std::floor(y / cell_);
  if (!(column >= 0 && row >= 0 && column < columns_ && row < rows_))
    return far;
  return distances_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                    static_cast<std::size_t>(column)];
}

bool MapFit::is_explained(const Pose2& scanner, double angle, double range) const {
  auto dx = std::cos(scanner.heading + angle);
  auto dy = std::sin(scanner.heading + angle);
  if (distance_at(scanner.x + range * dx, scanner.y + range * dy) > options_.near)
    return false;
  // Steps from the scanner, each as long as nothing can be in the way.
  for (double way = 0; way < range - options_.before_end;) {
    auto left = distance_at(scanner.x + way * dx, scanner.y + way * dy);
    if (left <= 0)
      return false;
    way += std::max(cell_ / 2, static_cast<double>(left) - cell_);
  }
  return true;
}

double MapFit::explained(const LaserScan& scan, const Pose2& robot) const {
  auto scanner = compose(between(origin_, robot), scan.mount);
  auto each =
    std::max<std::size_t>(1, scan.ranges.size() / std::max<std::size_t>(1, options_.beams));
  std::size_t beams = 0;
  std::size_t explained = 0;
  for (std::size_t i = 0; i < scan.ranges.size(); i += each) {
    if (!(scan.ranges[i] > 0) || scan.ranges[i] >= scan.max_range)
      continue;
    ++beams;
    explained += is_explained(scanner, scan.first_angle + static_cast<double>(i) * scan.angle_step,
                              static_cast<double>(scan.ranges[i]))
                   ? 1
                   : 0;
  }
  return beams == 0 ? 1 : static_cast<double>(explained) / static_cast<double>(beams);
}

} // namespace castor::mapping
