#include "castor/benchmarks/clevr/damage.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <opencv2/imgproc.hpp>

#include "castor/perception/vision/opencv_bridge.hpp"
#include "castor/perception/vision/recognition/regions.hpp"

namespace castor::clevr {

namespace {

using Mask = cv::Mat_<std::uint8_t>;

double between(double low, double high, std::mt19937& random) {
  return std::uniform_real_distribution<double>(low, high)(random);
}

cv::Point rounded(const cv::Point2d& point) {
  return {cvRound(point.x), cvRound(point.y)};
}

/// Removes what is beyond a line, or within a disc, from one side.
void cut(Mask& mask, const cv::Point2d& centre, double radius, std::mt19937& random) {
  const double angle = between(0, 2 * std::numbers::pi, random);
  const cv::Point2d direction(std::cos(angle), std::sin(angle));
  const double depth = between(0.1, 1.0, random) * radius;
  const cv::Point2d edge = centre + (radius - depth) * direction;
  if (between(0, 1, random) < 0.5) {
    const double other = between(0.6, 2, random) * radius;
    cv::circle(mask, rounded(edge + other * direction), cvRound(other), 0, cv::FILLED);
    return;
  }
  const cv::Point2d aside(-direction.y, direction.x);
  const double far = 10 * radius;
  const std::vector<cv::Point> half{rounded(edge + far * aside), rounded(edge - far * aside),
                                    rounded(edge - far * aside + far * direction),
                                    rounded(edge + far * aside + far * direction)};
  cv::fillConvexPoly(mask, half, 0);
}

/// Adds a disc at the outline.
void add_piece(Mask& mask, const cv::Point2d& centre, double radius, std::mt19937& random) {
  const double angle = between(0, 2 * std::numbers::pi, random);
  const double distance = between(0.8, 1.2, random) * radius;
  cv::circle(mask, rounded(centre + distance * cv::Point2d(std::cos(angle), std::sin(angle))),
             cvRound(between(0.15, 0.45, random) * radius), 255, cv::FILLED);
}

/// The largest part of the mask, as a segment.
vision::Segment segment_of(const Mask& mask) {
  std::vector<std::vector<cv::Point>> outlines;
  cv::findContours(mask, outlines, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
  vision::Segment segment;
  if (outlines.empty())
    return segment;
  const auto& largest =
    *std::max_element(outlines.begin(), outlines.end(), [](const auto& a, const auto& b) {
      return cv::contourArea(a) < cv::contourArea(b);
    });
  const cv::Rect box = cv::boundingRect(largest);
  Mask part(mask.size(), std::uint8_t{0});
  cv::fillPoly(part, std::vector{largest}, 255);
  segment.mask = vision::to_image(part(box));
  segment.box = {{box.x + (box.width - 1) / 2.0, box.y + (box.height - 1) / 2.0},
                 static_cast<double>(box.width),
                 static_cast<double>(box.height)};
  for (const auto& point : largest)
    segment.contour.push_back({static_cast<double>(point.x), static_cast<double>(point.y)});
  return segment;
}

} // namespace

vision::ROI damaged(const vision::ROI& region, const vision::Image& image, std::mt19937& random) {
  Mask mask(static_cast<int>(image.height), static_cast<int>(image.width), std::uint8_t{0});
  const cv::Mat own = vision::as_mat(region.mask);
  const cv::Rect box(cvRound(region.box.center.x - (region.box.width - 1) / 2),
                     cvRound(region.box.center.y - (region.box.height - 1) / 2), own.cols,
                     own.rows);
  own.copyTo(mask(box));
  const double radius = std::sqrt(cv::countNonZero(own) / std::numbers::pi);
  const cv::Point2d centre(region.box.center.x, region.box.center.y);
  const double choice = between(0, 1, random);
  if (choice < 0.5)
    cut(mask, centre, radius, random);
  else if (choice < 0.75)
    add_piece(mask, centre, radius, random);
  else if (choice < 0.875)
    cv::erode(mask, mask, cv::Mat());
  else
    cv::dilate(mask, mask, cv::Mat());
  const auto segment = segment_of(mask);
  return segment.contour.empty() ? vision::ROI{} : make_roi(image, segment);
}

} // namespace castor::clevr
