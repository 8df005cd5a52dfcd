#include "castor/perception/vision/segmentation/surface.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <opencv2/imgproc.hpp>

namespace castor::vision {

namespace {

constexpr double degrees = 180 / std::numbers::pi;

double dot(const ColourSum& a, const ColourSum& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

double norm(const ColourSum& a) {
  return std::sqrt(dot(a, a));
}

/// The direction of `sum`; that of white for black.
ColourSum direction(const ColourSum& sum) {
  const double length = norm(sum);
  if (length <= 0) {
    const double equal = 1 / std::numbers::sqrt3;
    return {equal, equal, equal};
  }
  return {sum[0] / length, sum[1] / length, sum[2] / length};
}

double mean_difference(const ColourSum& a, double a_count, const ColourSum& b, double b_count) {
  ColourSum difference{};
  for (std::size_t c = 0; c < difference.size(); ++c)
    difference[c] = a[c] / a_count - b[c] / b_count;
  return norm(difference);
}

} // namespace

Surface surface_of(const Area& area) {
  const ColourSum own = direction(area.light);
  const ColourSum ground = direction(area.ground_light);
  const double along = dot(own, ground);
  Surface surface;
  for (std::size_t c = 0; c < own.size(); ++c)
    surface.offset[c] = own[c] - along * ground[c];
  surface.angle = degrees * std::asin(std::min(1.0, norm(surface.offset)));
  const double ground_light = norm(area.ground_light);
  surface.brightness = ground_light > 0 ? std::sqrt(norm(area.light) / ground_light) : 1;
  return surface;
}

double ground_colourfulness(const Area& area) {
  const ColourSum white = direction({1, 1, 1});
  return degrees * std::acos(std::min(1.0, dot(direction(area.ground_light), white)));
}

double surface_difference(const Surface& a, const Surface& b, double saturation_weight) {
  const double product = norm(a.offset) * norm(b.offset);
  const double cosine = product > 0 ? dot(a.offset, b.offset) / product : 1;
  // The chord between the two hues, at the geometric mean of the two saturations.
  const double hue = degrees * std::sqrt(std::max(0.0, 2 - 2 * cosine) * product);
  return std::hypot(hue, saturation_weight * (a.angle - b.angle));
}

double lab_difference(const Area& a, const Area& b) {
  return mean_difference(a.lab, a.pixels(), b.lab, b.pixels());
}

double chroma_difference(const Area& a, const Area& b) {
  return std::hypot(a.lab[1] / a.pixels() - b.lab[1] / b.pixels(),
                    a.lab[2] / a.pixels() - b.lab[2] / b.pixels());
}

double ground_difference(const Area& area) {
  return mean_difference(area.lab, area.pixels(), area.ground_lab, area.pixels());
}

double colour_spread(const Area& area, const Grid<Colour>& lab) {
  double squares = 0;
  for (const int cell : area.cells) {
    for (std::size_t c = 0; c < area.lab.size(); ++c) {
      const double difference = static_cast<double>(lab[cell][c]) - area.lab[c] / area.pixels();
      squares += difference * difference;
    }
  }
  return std::sqrt(squares / area.pixels());
}

double shade_range(const Area& area, const Grid<float>& shade) {
  std::vector<float> shades;
  shades.reserve(area.cells.size());
  for (const int cell : area.cells)
    shades.push_back(shade[cell]);
  const auto quarter = static_cast<std::ptrdiff_t>(shades.size() / 4);
  std::nth_element(shades.begin(), shades.begin() + quarter, shades.end());
  const float low = shades[static_cast<std::size_t>(quarter)];
  const auto three = static_cast<std::ptrdiff_t>(3 * shades.size() / 4);
  std::nth_element(shades.begin(), shades.begin() + three, shades.end());
  return static_cast<double>(shades[static_cast<std::size_t>(three)] - low);
}

Extent extent_of(const Area& area, int width) {
  const auto [first, last] = std::minmax_element(area.cells.begin(), area.cells.end());
  return {*first / width, *last / width};
}

double compactness(const Area& area, int width) {
  std::vector<cv::Point> points;
  points.reserve(area.cells.size());
  for (const int cell : area.cells)
    points.emplace_back(cell % width, cell / width);
  const cv::Rect box = cv::boundingRect(points);
  // A rim of 0 all around, so that the border of the picture is a boundary too.
  cv::Mat_<std::uint8_t> mask(box.height + 2, box.width + 2, std::uint8_t{0});
  for (const auto& point : points)
    mask(point.y - box.y + 1, point.x - box.x + 1) = 1;
  cv::Mat distance;
  cv::distanceTransform(mask, distance, cv::DIST_L2, 3);
  double radius = 0;
  cv::minMaxLoc(distance, nullptr, &radius);
  return std::numbers::pi * radius * radius / area.pixels();
}

} // namespace castor::vision
