#include "castor/mapping/rooms/clearance.hpp"

#include <opencv2/imgproc.hpp>

#include <cmath>

namespace castor::mapping {

namespace {

constexpr std::uint8_t free_mark = 255;

void remove_furniture(cv::Mat& free, double largest_cells) {
  const cv::Mat blocked = ~free;
  cv::Mat components;
  cv::Mat statistics;
  cv::Mat centroids;
  cv::connectedComponentsWithStats(blocked, components, statistics, centroids, 8, CV_32S);
  const int margin = components.at<int>(0, 0);
  for (int row = 0; row < free.rows; ++row)
    for (int column = 0; column < free.cols; ++column) {
      auto component = components.at<int>(row, column);
      if (component == 0 || component == margin)
        continue;
      auto diagonal = std::hypot(statistics.at<int>(component, cv::CC_STAT_WIDTH),
                                 statistics.at<int>(component, cv::CC_STAT_HEIGHT));
      if (diagonal <= largest_cells)
        free.at<std::uint8_t>(row, column) = free_mark;
    }
}

} // namespace

Raster<float> clearance(const CellMap& map, double largest_furniture, int free_to) {
  Raster<float> result(map.columns, map.rows, 0);
  cv::Mat free(map.rows + 2, map.columns + 2, CV_8U, cv::Scalar(0));
  for (int row = 0; row < map.rows; ++row)
    for (int column = 0; column < map.columns; ++column)
      if (auto cell = map.at(column, row); cell >= 0 && cell <= free_to)
        free.at<std::uint8_t>(row + 1, column + 1) = free_mark;
  remove_furniture(free, largest_furniture / map.cell_size);
  cv::Mat distances(free.rows, free.cols, CV_32F, result.cells.data());
  cv::distanceTransform(free, distances, cv::DIST_L2, cv::DIST_MASK_PRECISE, CV_32F);
  return result;
}

} // namespace castor::mapping
