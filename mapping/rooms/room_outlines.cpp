#include "castor/mapping/rooms/room_outlines.hpp"

#include <opencv2/imgproc.hpp>

#include <algorithm>

namespace castor::mapping {

std::vector<OutlineCorner> outline_of(const Raster<std::int32_t>& labels, std::int32_t label) {
  cv::Mat mask(labels.rows + 2, labels.columns + 2, CV_8U, cv::Scalar(0));
  for (int i = 0; i < labels.size(); ++i)
    if (labels[i] == label)
      mask.at<std::uint8_t>(labels.row(i) + 1, labels.column(i) + 1) = 255;
  std::vector<std::vector<cv::Point>> outlines;
  cv::findContours(mask, outlines, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
  if (outlines.empty())
    return {};
  auto outline = *std::ranges::max_element(
    outlines, {}, [](const auto& x) { return std::pair(cv::contourArea(x), x.size()); });
  std::vector<cv::Point> corners;
  cv::approxPolyDP(outline, corners, 1, true);
  // With rows that go up, a positive area is anticlockwise.
  if (cv::contourArea(corners, true) < 0)
    std::ranges::reverse(corners);
  std::vector<OutlineCorner> result;
  for (const auto& x : corners)
    result.emplace_back(x.x - 1, x.y - 1);
  return result;
}

} // namespace castor::mapping
