#include "castor/perception/vision/recognition/shape_evidence.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include <opencv2/imgproc.hpp>

#include "castor/perception/vision/opencv_bridge.hpp"
#include "castor/perception/vision/recognition/outline_fit.hpp"

namespace castor::vision {

namespace {

constexpr int directions = 24;
constexpr int grid_cells = 4;
constexpr std::size_t bands = 8;
constexpr int min_pixels = 12;

/// Least brightness that contrast is relative to, as a share of the ground's: on darker things,
/// what the rim has of the ground and reflections is more than their shading. All things of CLEVR's
/// images are brighter than that.
constexpr double dark_share = 0.4;
/// Brightness of a ground that is not in the region's box, of 255.
constexpr double usual_ground = 110;
/// Where all is dark.
constexpr double least_unit = 8;

using Mask = cv::Mat_<std::uint8_t>;
using Brightness = cv::Mat_<float>;

/// The largest outline, in pixels of the mask's box.
std::vector<cv::Point> outline_of(const Mask& mask) {
  std::vector<std::vector<cv::Point>> outlines;
  cv::findContours(mask, outlines, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
  return *std::max_element(outlines.begin(), outlines.end(), [](const auto& a, const auto& b) {
    return cv::contourArea(a) < cv::contourArea(b);
  });
}

double ellipse_overlap(const Mask& mask, const cv::Moments& moments) {
  const double a = moments.mu20 / moments.m00;
  const double b = moments.mu11 / moments.m00;
  const double c = moments.mu02 / moments.m00;
  const double determinant = a * c - b * b;
  const cv::Point2d centre(moments.m10 / moments.m00, moments.m01 / moments.m00);
  int both = 0;
  int either = 0;
  // The ellipse may reach out of the box.
  for (int y = -mask.rows / 2; y < mask.rows + mask.rows / 2; ++y) {
    for (int x = -mask.cols / 2; x < mask.cols + mask.cols / 2; ++x) {
      const double u = x - centre.x;
      const double v = y - centre.y;
      // Within two standard deviations, as a uniform ellipse is.
      const bool in_ellipse = (c * u * u - 2 * b * u * v + a * v * v) <= 4 * determinant;
      const bool in_mask = x >= 0 && y >= 0 && x < mask.cols && y < mask.rows && mask(y, x) != 0;
      both += in_ellipse && in_mask ? 1 : 0;
      either += in_ellipse || in_mask ? 1 : 0;
    }
  }
  return static_cast<double>(both) / either;
}

void measure_outline(const Mask& mask, std::vector<double>& result) {
  const auto outline = outline_of(mask);
  const cv::Moments moments = cv::moments(mask, true);
  const double area = moments.m00;
  const double radius = std::sqrt(area / std::numbers::pi);
  std::vector<cv::Point> hull;
  cv::convexHull(outline, hull);
  for (int i = 0; i < directions; ++i) {
    const double angle = 2 * std::numbers::pi * i / directions;
    double reach = 0;
    for (const auto& corner : hull)
      reach = std::max(reach, (corner.x - moments.m10 / area) * std::cos(angle) -
                                (corner.y - moments.m01 / area) * std::sin(angle));
    // Half a pixel from the centre of the outermost pixels to their edge.
    result.push_back((reach + 0.5) / radius);
  }
  // Areas and lengths within an outline run through pixel centres: without half the outline.
  const double hull_area = cv::contourArea(hull) + cv::arcLength(hull, true) / 2 + 1;
  result.push_back(std::min(1.0, area / hull_area));
  result.push_back(ellipse_overlap(mask, moments));
  const cv::Size2f sides = cv::minAreaRect(outline).size;
  result.push_back(std::min(1.0, area / ((static_cast<double>(sides.width) + 1) *
                                         (static_cast<double>(sides.height) + 1))));
  std::vector<cv::Point2f> triangle;
  const double triangle_area = cv::minEnclosingTriangle(hull, triangle);
  const double triangle_edge = triangle.empty() ? 0 : cv::arcLength(triangle, true);
  result.push_back(std::min(1.0, area / (triangle_area + triangle_edge / 2 + 1)));
  for (const double tolerance : {0.04, 0.08}) {
    std::vector<cv::Point> polygon;
    cv::approxPolyDP(hull, polygon, tolerance * cv::arcLength(hull, true), true);
    result.push_back(static_cast<double>(polygon.size()) / 5);
  }
}

/// A mean that is also defined over nothing.
struct Mean {
  double sum = 0;
  int count = 0;

  void add(double value) {
    sum += value;
    ++count;
  }
  double value(double otherwise) const { return count > 0 ? sum / count : otherwise; }
};

void measure_steps(const std::array<Mean, bands>& profile, double unit,
                   std::vector<double>& result) {
  double largest = 0;
  double total = 0;
  const Mean* previous = nullptr;
  for (const auto& mean : profile) {
    if (mean.count == 0)
      continue;
    if (previous != nullptr) {
      const double step = std::abs(mean.value(0) - previous->value(0));
      largest = std::max(largest, step);
      total += step;
    }
    previous = &mean;
  }
  result.push_back(largest / unit);
  result.push_back(total > 0 ? largest / total : 0);
}

/// Median brightness around the region, within its box.
double ground_brightness(const Brightness& light, const Mask& mask) {
  std::vector<float> around;
  for (int y = 0; y < mask.rows; ++y)
    for (int x = 0; x < mask.cols; ++x)
      if (mask(y, x) == 0)
        around.push_back(light(y, x));
  if (around.size() < static_cast<std::size_t>(min_pixels))
    return usual_ground;
  const auto middle = around.begin() + static_cast<std::ptrdiff_t>(around.size() / 2);
  std::nth_element(around.begin(), middle, around.end());
  return static_cast<double>(*middle);
}

void measure_light(const Brightness& light, const Mask& mask, std::vector<double>& result) {
  // The outermost pixels are mixed with the ground.
  Mask framed;
  cv::copyMakeBorder(mask, framed, 1, 1, 1, 1, cv::BORDER_CONSTANT, 0);
  Mask eroded;
  cv::erode(framed, eroded, cv::Mat());
  Mask inside = eroded(cv::Rect(1, 1, mask.cols, mask.rows));
  if (cv::countNonZero(inside) < min_pixels)
    inside = mask;
  Mean all;
  Mean squares;
  std::array<Mean, grid_cells * grid_cells> grid;
  std::array<Mean, bands> upper_columns;
  std::array<Mean, bands> lower_columns;
  std::array<Mean, bands> rows;
  for (int y = 0; y < mask.rows; ++y) {
    for (int x = 0; x < mask.cols; ++x) {
      if (inside(y, x) == 0)
        continue;
      const auto value = static_cast<double>(light(y, x));
      all.add(value);
      squares.add(value * value);
      grid[static_cast<std::size_t>(y * grid_cells / mask.rows * grid_cells +
                                    x * grid_cells / mask.cols)]
        .add(value);
      const auto column = static_cast<std::size_t>(x) * bands / static_cast<std::size_t>(mask.cols);
      (2 * y < mask.rows ? upper_columns : lower_columns)[column].add(value);
      rows[static_cast<std::size_t>(y) * bands / static_cast<std::size_t>(mask.rows)].add(value);
    }
  }
  const double mean = all.value(0);
  const double unit = std::max({mean, dark_share * ground_brightness(light, mask), least_unit});
  for (const auto& cell : grid)
    result.push_back((cell.value(mean) - mean) / unit);
  result.push_back(std::sqrt(std::max(0.0, squares.value(0) - mean * mean)) / unit);
  measure_steps(upper_columns, unit, result);
  measure_steps(lower_columns, unit, result);
  measure_steps(rows, unit, result);
}

std::vector<std::string> make_names() {
  std::vector<std::string> names;
  for (int i = 0; i < directions; ++i)
    names.push_back("support_" + std::to_string(i));
  names.insert(names.end(),
               {"solidity", "ellipse", "rectangle", "triangle", "corners_4", "corners_8"});
  for (int i = 0; i < grid_cells * grid_cells; ++i)
    names.push_back("light_" + std::to_string(i));
  names.insert(names.end(), {"variation", "step_upper", "smooth_upper", "step_lower",
                             "smooth_lower", "step_rows", "smooth_rows"});
  names.insert(names.end(), fit_measurements().begin(), fit_measurements().end());
  return names;
}

} // namespace

const std::vector<std::string>& shape_measurements() {
  static const std::vector<std::string> names = make_names();
  return names;
}

std::vector<double> measure_shape(const Image& region, const Image& mask,
                                  std::span<const double> fit) {
  if (!fit.empty() && fit.size() != fit_measurements().size())
    throw std::invalid_argument("measure_shape: the fit has the wrong number of measurements");
  if (mask.channels != 1 || mask.width != region.width || mask.height != region.height)
    throw std::invalid_argument("measure_shape: the mask must have 1 channel and the region's "
                                "size");
  const Mask belongs = as_mat(mask);
  cv::Mat grey = as_mat(region);
  if (region.channels == 3)
    cv::cvtColor(grey, grey, cv::COLOR_BGR2GRAY);
  if (belongs.empty() || cv::countNonZero(belongs) < min_pixels)
    return {};
  const cv::Moments moments = cv::moments(belongs, true);
  if (moments.mu20 * moments.mu02 - moments.mu11 * moments.mu11 < 1)
    return {};
  std::vector<double> result;
  measure_outline(belongs, result);
  Brightness light;
  grey.convertTo(light, CV_32F);
  measure_light(light, belongs, result);
  result.insert(result.end(), fit.begin(), fit.end());
  result.resize(shape_measurements().size(), 0);
  return result;
}

} // namespace castor::vision
