#include "castor/perception/vision/recognition/outline_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

#include <opencv2/imgproc.hpp>

#include "castor/perception/vision/opencv_bridge.hpp"
#include "castor/perception/vision/recognition/outline_models.hpp"
#include "castor/perception/vision/recognition/size_on_table.hpp"

namespace castor::vision {

namespace {

/// In units of the radius of the disc of the region's area.
constexpr double fit_tolerance = 0.08;
constexpr double across_edge = 0.14;
/// Of the thickness of flat pieces, in units of the width.
constexpr double thin = 0.06;

using RegionMask = cv::Mat_<std::uint8_t>;
using RegionLight = cv::Mat_<float>;

/// A model and how it lies on the outline.
struct Fit {
  OutlineModel model;
  Alignment alignment;
};

/// Keeps the better of two.
void keep_better(std::optional<Fit>& best, std::optional<OutlineModel> model,
                 const Support& outline, double radius) {
  if (!model)
    return;
  const Alignment alignment = align(model->support, outline, fit_tolerance * radius);
  if (!best || alignment.deviation < best->alignment.deviation)
    best = Fit{std::move(*model), alignment};
}

std::optional<Fit> fit_box(const Camera& camera, const Stand& stand, double height,
                           const Support& outline, double radius) {
  constexpr int yaws = 12;
  std::optional<Fit> best;
  for (int i = 0; i < yaws; ++i)
    keep_better(best, model_box(camera, stand, i * std::numbers::pi / 2 / yaws, height), outline,
                radius);
  return best;
}

std::optional<Fit> fit_cylinder(const Camera& camera, const Stand& stand, const Support& outline,
                                double radius, std::initializer_list<double> heights) {
  std::optional<Fit> best;
  for (const double height : heights)
    keep_better(best, model_cylinder(camera, stand, height), outline, radius);
  return best;
}

/// Brightness of a region, in the coordinates of its box.
class Interior {
public:
  Interior(const Image& region, const Image& mask, const Point2& corner)
    : corner_(corner), mask_(as_mat(mask)) {
    cv::Mat grey = as_mat(region);
    if (region.channels == 3)
      cv::cvtColor(grey, grey, cv::COLOR_BGR2GRAY);
    cv::GaussianBlur(grey, grey, {3, 3}, 0);
    grey.convertTo(light_, CV_32F);
    // The outermost pixels are mixed with the ground.
    RegionMask framed;
    cv::copyMakeBorder(mask_, framed, 1, 1, 1, 1, cv::BORDER_CONSTANT, 0);
    cv::erode(framed, framed, cv::Mat());
    const RegionMask inner = framed(cv::Rect(1, 1, mask_.cols, mask_.rows));
    if (cv::countNonZero(inner) >= 12)
      mask_ = inner;
    unit_ = std::max(cv::mean(light_, mask_)[0], 8.0);
  }

  /// Share of the variance of brightness that is between the faces; all else is a face, too.
  double between_faces(const Fit& fit) const {
    RegionMask labels(mask_.size(), std::uint8_t{0});
    constexpr int shift = 4;
    for (std::size_t i = 0; i < fit.model.faces.size(); ++i) {
      std::vector<cv::Point> polygon;
      for (const auto& corner : fit.model.faces[i]) {
        const Point2 pixel = in_box(fit.alignment(corner));
        polygon.emplace_back(cvRound(pixel.x * (1 << shift)), cvRound(pixel.y * (1 << shift)));
      }
      cv::fillConvexPoly(labels, polygon, cv::Scalar(static_cast<double>(i) + 1), cv::LINE_8,
                         shift);
    }
    std::array<double, max_faces> sums{};
    std::array<double, max_faces> counts{};
    double sum = 0;
    double squares = 0;
    double count = 0;
    for (int y = 0; y < mask_.rows; ++y) {
      for (int x = 0; x < mask_.cols; ++x) {
        if (mask_(y, x) == 0)
          continue;
        const auto light = static_cast<double>(light_(y, x));
        sums[labels(y, x)] += light;
        counts[labels(y, x)] += 1;
        sum += light;
        squares += light * light;
        count += 1;
      }
    }
    const double mean = sum / count;
    double between = 0;
    for (std::size_t i = 0; i < sums.size(); ++i)
      if (counts[i] > 0)
        between += counts[i] * std::pow(sums[i] / counts[i] - mean, 2);
    const double all = squares - count * mean * mean;
    // Even surfaces have nothing but noise.
    return between / (all + count);
  }

  /// Mean step of brightness across a line at this distance from it on both sides, in units of the
  /// mean.
  double step_across(const Point2& from, const Point2& to, double distance) const {
    const double length = std::hypot(to.x - from.x, to.y - from.y);
    if (!(length > 0))
      return 0;
    const Point2 aside{-(to.y - from.y) / length * distance, (to.x - from.x) / length * distance};
    double sum = 0;
    int count = 0;
    constexpr int places = 9;
    for (int i = 0; i < places; ++i) {
      const double t = 0.15 + 0.7 * i / (places - 1);
      const Point2 at{from.x + t * (to.x - from.x), from.y + t * (to.y - from.y)};
      const auto one = light_at({at.x + aside.x, at.y + aside.y});
      const auto other = light_at({at.x - aside.x, at.y - aside.y});
      if (one && other) {
        sum += *one - *other;
        ++count;
      }
    }
    return count > 0 ? std::abs(sum) / count / unit_ : 0;
  }

  double step_across(const std::vector<Point2>& line, const Alignment& alignment,
                     double distance) const {
    double sum = 0;
    for (std::size_t i = 1; i < line.size(); ++i)
      sum += step_across(alignment(line[i - 1]), alignment(line[i]), distance);
    return line.size() < 2 ? 0 : sum / static_cast<double>(line.size() - 1);
  }

private:
  /// The cube's top and two sides, and what is outside of them.
  static constexpr std::size_t max_faces = 4;

  Point2 in_box(const Point2& pixel) const { return {pixel.x - corner_.x, pixel.y - corner_.y}; }

  std::optional<double> light_at(const Point2& pixel) const {
    const Point2 place = in_box(pixel);
    const int x = cvRound(place.x);
    const int y = cvRound(place.y);
    if (x < 0 || y < 0 || x >= mask_.cols || y >= mask_.rows || mask_(y, x) == 0)
      return std::nullopt;
    return static_cast<double>(light_(y, x));
  }

  Point2 corner_;
  RegionMask mask_;
  RegionLight light_;
  double unit_ = 1;
};

double badness(const std::optional<Fit>& fit, double radius) {
  constexpr double floor = 0.5;
  const double deviation = fit ? fit->alignment.deviation / radius : fit_tolerance;
  return std::log(100 * deviation + floor);
}

/// What models are fitted to.
struct Outline {
  Stand stand;
  /// Of the disc of the region's area, pixels.
  double radius = 0;
  Support support;
};

/// Nothing if the region's foot is not on the visible table.
std::optional<Outline> outline_of(const ROI& roi, const Camera& camera) {
  const auto extent = extent_on_table(camera, roi.contour);
  const int pixels = cv::countNonZero(as_mat(roi.mask));
  if (!extent || !(extent->size.x > 0) || pixels == 0)
    return {};
  Outline result{{extent->centroid.x, extent->centroid.y, extent->size.x},
                 std::sqrt(pixels / std::numbers::pi),
                 support_of(roi.contour)};
  // Contours run through pixel centres; the region reaches half a pixel further.
  for (double& reach : result.support)
    reach += 0.5;
  return result;
}

} // namespace

const std::vector<std::string>& fit_measurements() {
  static const std::vector<std::string> names{
    "fit_cube",   "fit_cylinder", "fit_tall",       "fit_sphere",   "fit_circle",    "fit_square",
    "sure_fit",   "faces_cube",   "faces_cylinder", "edge_upright", "sharp_upright", "edge_rim",
    "edge_round", "seen"};
  return names;
}

std::vector<double> measure_fit(const ROI& roi, const Camera& camera) {
  std::vector<double> result(fit_measurements().size(), 0);
  const auto seen = outline_of(roi, camera);
  if (!seen)
    return result;
  const auto& [stand, radius, outline] = *seen;
  const auto cube = fit_box(camera, stand, 1, outline, radius);
  const auto cylinder = fit_cylinder(camera, stand, outline, radius, {1});
  const auto tall = fit_cylinder(camera, stand, outline, radius, {0.7, 0.85, 1.2, 1.4, 1.7});
  std::optional<Fit> sphere;
  keep_better(sphere, model_sphere(camera, stand), outline, radius);
  const auto circle = fit_cylinder(camera, stand, outline, radius, {thin});
  const auto square = fit_box(camera, stand, thin, outline, radius);
  if (!cube || !cylinder)
    return result;
  const std::array solids{badness(cube, radius), badness(cylinder, radius),
                          badness(sphere, radius)};
  auto ranked = solids;
  std::sort(ranked.begin(), ranked.end());
  const Interior interior(
    roi.region, roi.mask,
    {roi.box.center.x - (roi.box.width - 1) / 2, roi.box.center.y - (roi.box.height - 1) / 2});
  const double near = across_edge * radius;
  const double upright = interior.step_across(cube->model.upright, cube->alignment, near);
  const double wide = interior.step_across(cube->model.upright, cube->alignment, 3 * near);
  return {solids[0],
          solids[1],
          badness(tall, radius),
          solids[2],
          badness(circle, radius),
          badness(square, radius),
          ranked[1] - ranked[0],
          interior.between_faces(*cube),
          interior.between_faces(*cylinder),
          upright,
          upright / (upright + wide + 0.02),
          interior.step_across(cube->model.rim, cube->alignment, near),
          interior.step_across(cylinder->model.rim, cylinder->alignment, near),
          1};
}

std::map<std::string, double> outline_deviations(const ROI& roi, const Camera& camera) {
  const auto seen = outline_of(roi, camera);
  if (!seen)
    return {};
  const auto& [stand, radius, outline] = *seen;
  std::optional<Fit> sphere;
  keep_better(sphere, model_sphere(camera, stand), outline, radius);
  const std::map<std::string, std::optional<Fit>> fits{
    {"cube", fit_box(camera, stand, 1, outline, radius)},
    {"cylinder",
     fit_cylinder(camera, stand, outline, radius, {0.5, 0.7, 0.85, 1, 1.2, 1.4, 1.7, 2, 2.4})},
    {"sphere", sphere},
    {"circle", fit_cylinder(camera, stand, outline, radius, {thin})},
    {"square", fit_box(camera, stand, thin, outline, radius)}};
  std::map<std::string, double> result;
  for (const auto& [shape, fit] : fits)
    result[shape] = fit ? fit->alignment.deviation / radius : fit_tolerance;
  return result;
}

} // namespace castor::vision
