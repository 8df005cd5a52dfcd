#include "castor/perception/vision/segmentation/neck.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include <opencv2/imgproc.hpp>

namespace castor::vision {

namespace {

using NeckMask = cv::Mat_<std::uint8_t>;

/// A part of the mask: its pixels, where it is from, and how convex and wide it is.
struct Part {
  std::vector<cv::Point> points;
  /// Share of the convex hull that the part fills.
  double solidity = 0;
  /// The diameter of the largest disc in it; pixels.
  double width = 0;
};

/// The hull's area in whole pixels: polygons run through the middles of their pixels.
double hull_pixels(const std::vector<cv::Point>& points) {
  std::vector<cv::Point> hull;
  cv::convexHull(points, hull);
  return cv::contourArea(hull) + cv::arcLength(hull, true) / 2 + 1;
}

double diameter(const NeckMask& mask) {
  cv::Mat distance;
  cv::distanceTransform(mask, distance, cv::DIST_L2, 5);
  double radius = 0;
  cv::minMaxLoc(distance, nullptr, &radius);
  return 2 * radius;
}

Part make_neck_part(std::vector<cv::Point> points, const NeckMask& mask) {
  Part part;
  part.solidity = static_cast<double>(points.size()) / hull_pixels(points);
  part.width = diameter(mask);
  part.points = std::move(points);
  return part;
}

/// Corners at which the outline turns inwards by at least `angle` degrees.
std::vector<cv::Point> inward_corners(const NeckMask& mask, const NeckOptions& options) {
  std::vector<std::vector<cv::Point>> contours;
  cv::findContours(mask, contours, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
  if (contours.size() != 1)
    return {};
  std::vector<cv::Point> polygon;
  cv::approxPolyDP(contours.front(), polygon, options.tolerance, true);
  const double orientation = cv::contourArea(polygon, true) < 0 ? -1 : 1;
  std::vector<cv::Point> corners;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const cv::Point from = polygon[(i + polygon.size() - 1) % polygon.size()];
    const cv::Point to = polygon[(i + 1) % polygon.size()];
    const cv::Point in = polygon[i] - from;
    const cv::Point out = to - polygon[i];
    const double turn = std::atan2(in.cross(out), in.dot(out)) * 180 / std::numbers::pi;
    if (-orientation * turn > options.min_turn)
      corners.push_back(polygon[i]);
  }
  return corners;
}

/// The two parts on either side of the line; nothing if it does not divide the mask in two.
std::optional<std::pair<Part, Part>> cut_along(const NeckMask& mask, const cv::Point& from,
                                               const cv::Point& to) {
  NeckMask divided = mask.clone();
  cv::line(divided, from, to, 0, 1, cv::LINE_8);
  cv::Mat_<int> labels;
  // Diagonal neighbours are no neighbours, or they would meet across the line.
  if (cv::connectedComponents(divided, labels, 4, CV_32S) != 3)
    return std::nullopt;
  std::vector<cv::Point> points[2];
  NeckMask masks[2] = {NeckMask(mask.size(), std::uint8_t{0}),
                       NeckMask(mask.size(), std::uint8_t{0})};
  for (int y = 0; y < mask.rows; ++y) {
    for (int x = 0; x < mask.cols; ++x) {
      if (mask(y, x) == 0)
        continue;
      // The line itself is with the first part.
      const std::size_t side = labels(y, x) == 2 ? 1 : 0;
      points[side].emplace_back(x, y);
      masks[side](y, x) = 255;
    }
  }
  return std::pair(make_neck_part(std::move(points[0]), masks[0]),
                   make_neck_part(std::move(points[1]), masks[1]));
}

bool are_things(const std::pair<Part, Part>& parts, double whole_solidity, double length,
                const NeckOptions& options) {
  const auto& [a, b] = parts;
  const double whole = static_cast<double>(a.points.size() + b.points.size());
  const auto smaller = static_cast<double>(std::min(a.points.size(), b.points.size()));
  const double open = (1 - a.solidity) * static_cast<double>(a.points.size()) +
                      (1 - b.solidity) * static_cast<double>(b.points.size());
  return smaller >= options.min_pixels && smaller >= options.min_share * whole &&
         length <= options.max_length * std::min(a.width, b.width) &&
         std::min(a.solidity, b.solidity) >= options.min_solidity &&
         open <= options.max_rest * (1 - whole_solidity) * whole;
}

std::vector<std::vector<cv::Point>> divide_points(const std::vector<cv::Point>& points,
                                                  const NeckOptions& options) {
  const auto whole = static_cast<double>(points.size());
  const double solidity = whole / hull_pixels(points);
  if (whole < 2 * options.min_pixels || solidity > options.convex)
    return {points};
  const cv::Rect box = cv::boundingRect(points);
  // A rim of 0 all around, so that the border of the mask is a boundary too.
  const cv::Point offset = box.tl() - cv::Point(1, 1);
  NeckMask mask(box.height + 2, box.width + 2, std::uint8_t{0});
  for (const auto& point : points)
    mask(point - offset) = 255;
  const auto corners = inward_corners(mask, options);
  if (corners.size() > options.max_corners)
    return {points};
  std::optional<std::pair<Part, Part>> best;
  double shortest = 0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    for (std::size_t j = i + 1; j < corners.size(); ++j) {
      const double length = cv::norm(corners[i] - corners[j]);
      if (best && length >= shortest)
        continue;
      auto parts = cut_along(mask, corners[i], corners[j]);
      if (parts && are_things(*parts, solidity, length, options)) {
        best = std::move(parts);
        shortest = length;
      }
    }
  }
  if (!best)
    return {points};
  std::vector<std::vector<cv::Point>> result;
  for (Part* part : {&best->first, &best->second}) {
    for (auto& point : part->points)
      point += offset;
    result.push_back(std::move(part->points));
  }
  return result;
}

} // namespace

std::vector<std::vector<int>> divide_at_necks(const std::vector<int>& cells, int width,
                                              const NeckOptions& options) {
  std::vector<cv::Point> points;
  points.reserve(cells.size());
  for (const int cell : cells)
    points.emplace_back(cell % width, cell / width);
  std::vector<std::vector<int>> result;
  for (const auto& part : divide_points(points, options)) {
    auto& part_cells = result.emplace_back();
    part_cells.reserve(part.size());
    for (const auto& point : part)
      part_cells.push_back(point.y * width + point.x);
  }
  return result;
}

} // namespace castor::vision
