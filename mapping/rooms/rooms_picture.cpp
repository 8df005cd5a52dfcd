#include "castor/mapping/rooms/rooms_picture.hpp"

#include "castor/base/picture_files.hpp"

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include <cmath>
#include <cstddef>
#include <stdexcept>
#include <string>

namespace castor::mapping {

namespace {

/// Colours of rooms whose numbers follow each other differ much: hues by the golden angle.
cv::Vec3b colour_of(std::int32_t number) {
  constexpr double golden_angle = 137.508; // degrees
  const cv::Mat hsv(1, 1, CV_8UC3, cv::Scalar(std::fmod(number * golden_angle, 360) / 2, 90, 235));
  cv::Mat bgr;
  cv::cvtColor(hsv, bgr, cv::COLOR_HSV2BGR);
  return bgr.at<cv::Vec3b>(0, 0);
}

} // namespace

std::vector<std::uint8_t> picture_of(const CellMap& map, const SegmentedRooms& rooms) {
  if (map.columns <= 0 || map.rows <= 0)
    throw std::runtime_error("the map has no cells that could be drawn");
  cv::Mat image(map.rows, map.columns, CV_8UC3, cv::Scalar(0, 0, 0));
  std::vector<cv::Vec3b> colours;
  for (const auto& x : rooms.rooms)
    colours.push_back(colour_of(x.number));
  for (int row = 0; row < map.rows; ++row)
    for (int column = 0; column < map.columns; ++column) {
      auto label =
        rooms.labels[static_cast<std::size_t>(row) * static_cast<std::size_t>(map.columns) +
                     static_cast<std::size_t>(column)];
      if (label == 0)
        continue;
      auto& pixel = image.at<cv::Vec3b>(map.rows - 1 - row, column);
      pixel = colours[static_cast<std::size_t>(label - 1)];
      if (map.at(column, row) != 0)
        pixel *= 0.6;
    }
  const auto to_map = inverse(map.origin);
  auto pixel_of = [&](const Point2& x) {
    auto at = transform(to_map, x);
    return cv::Point(static_cast<int>(at.x / map.cell_size),
                     map.rows - 1 - static_cast<int>(at.y / map.cell_size));
  };
  for (const auto& x : rooms.openings)
    cv::line(image, pixel_of(x.from), pixel_of(x.to), cv::Scalar(40, 40, 220), 2);
  for (const auto& x : rooms.rooms)
    cv::putText(image, std::to_string(x.number), pixel_of(x.centre), cv::FONT_HERSHEY_SIMPLEX, 0.5,
                cv::Scalar(60, 40, 30), 1, cv::LINE_AA);
  return encode_png(image.cols, image.rows, image.channels(),
                    {image.data, image.total() * image.elemSize()});
}

} // namespace castor::mapping
