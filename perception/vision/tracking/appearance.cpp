#include "castor/perception/vision/tracking/appearance.hpp"

#include "castor/perception/vision/opencv_bridge.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <utility>
#include <vector>

#include <opencv2/imgproc.hpp>

namespace castor::vision {

namespace {

/// Lightness is told less finely than the two axes of colour: it changes with every move under a
/// lamp.
constexpr std::array<int, 3> bins{8, 16, 16};
constexpr int histogram_cells = bins[0] * bins[1] * bins[2];

using Histogram = std::vector<float>;

/// Calls `f(cell, weight)` for the eight cells that a colour lies between, so that noise and small
/// changes of light do not move it from one cell to the next all at once.
template <class F>
void spread(const cv::Vec3b& lab, F&& f) {
  std::array<int, 3> low{};
  std::array<float, 3> part{};
  for (std::size_t i = 0; i < 3; ++i) {
    auto x = static_cast<float>(lab[static_cast<int>(i)]) * static_cast<float>(bins[i] - 1) / 255;
    low[i] = std::min(static_cast<int>(x), bins[i] - 2);
    part[i] = x - static_cast<float>(low[i]);
  }
  for (int corner = 0; corner < 8; ++corner) {
    int cell = 0;
    float weight = 1;
    for (std::size_t i = 0; i < 3; ++i) {
      auto up = (corner >> i) & 1;
      cell = cell * bins[i] + low[i] + up;
      weight *= up ? part[i] : 1 - part[i];
    }
    f(static_cast<std::size_t>(cell), weight);
  }
}

/// Sums to the number of pixels that count.
Histogram histogram(const cv::Mat& lab, const cv::Mat& mask) {
  Histogram result(histogram_cells);
  for (int y = 0; y < lab.rows; ++y)
    for (int x = 0; x < lab.cols; ++x)
      if (mask.empty() || mask.at<std::uint8_t>(y, x) != 0)
        spread(lab.at<cv::Vec3b>(y, x), [&](std::size_t cell, float w) { result[cell] += w; });
  return result;
}

void scale_to_one(Histogram& x) {
  double sum = 0;
  for (auto weight : x)
    sum += weight;
  for (auto& weight : x)
    weight = static_cast<float>(weight / sum);
}

cv::Mat to_lab(const Image& image) {
  if (image.channels != 3 || image.bytes.empty())
    throw std::invalid_argument("an appearance needs pixels with 3 channels");
  cv::Mat lab;
  cv::cvtColor(as_mat(image), lab, cv::COLOR_BGR2Lab);
  return lab;
}

} // namespace

struct ColourPicture::Pixels {
  cv::Mat lab;
};

ColourPicture::ColourPicture(const Image& image)
  : pixels_(std::make_unique<Pixels>(Pixels{to_lab(image)})) {}

ColourPicture::ColourPicture(ColourPicture&&) noexcept = default;
ColourPicture& ColourPicture::operator=(ColourPicture&&) noexcept = default;
ColourPicture::~ColourPicture() = default;

struct Appearance::Look {
  /// Empty: all of the box.
  cv::Mat mask;
  /// Sums to 1.
  Histogram colours;
};

Appearance::Appearance(const Image& region, const Image& mask) : look_(std::make_unique<Look>()) {
  auto lab = to_lab(region);
  if (!mask.bytes.empty()) {
    if (mask.width != region.width || mask.height != region.height || mask.channels != 1)
      throw std::invalid_argument("an appearance needs a mask of the region's size");
    look_->mask = as_mat(mask).clone();
    if (cv::countNonZero(look_->mask) == 0)
      throw std::invalid_argument("an appearance needs at least one pixel");
  }
  look_->colours = histogram(lab, look_->mask);
  scale_to_one(look_->colours);
}

Appearance::Appearance(Appearance&&) noexcept = default;
Appearance& Appearance::operator=(Appearance&&) noexcept = default;
Appearance::~Appearance() = default;

double Appearance::similarity(const ColourPicture& picture, const ImageBox& box) const {
  auto& lab = picture.pixels_->lab;
  auto rect = pixels_of(box);
  auto seen = rect & cv::Rect(0, 0, lab.cols, lab.rows);
  if (seen.empty())
    return 0;
  cv::Mat mask;
  auto all = static_cast<double>(rect.area());
  if (!look_->mask.empty()) {
    cv::resize(look_->mask, mask, rect.size(), 0, 0, cv::INTER_NEAREST);
    all = cv::countNonZero(mask);
    mask = mask(seen - rect.tl());
  }
  if (all == 0)
    return 0;
  auto colours = histogram(lab(seen), mask);
  double sum = 0;
  for (std::size_t i = 0; i < colours.size(); ++i)
    sum += std::sqrt(colours[i] / all * look_->colours[i]);
  return sum;
}

std::optional<ImageBox> Appearance::find(const ColourPicture& picture, double width, double height,
                                         std::span<const ImageBox> taken, double least) const {
  // Half the resolution tells where to look; pictures smaller than that are not worth the loss.
  constexpr int working_side = 320;
  auto& full = picture.pixels_->lab;
  auto factor = std::min(1.0, static_cast<double>(working_side) / std::max(full.cols, full.rows));
  cv::Mat lab;
  cv::resize(full, lab, {}, factor, factor, cv::INTER_NEAREST);
  // M. J. Swain and D. H. Ballard, "Color indexing" (1991): each pixel counts by how much more of
  // its colour the thing has than the picture.
  auto common = histogram(lab, {});
  auto area = static_cast<float>(width * height * factor * factor);
  cv::Mat evidence(lab.size(), CV_32F);
  for (int y = 0; y < lab.rows; ++y)
    for (int x = 0; x < lab.cols; ++x) {
      float sum = 0;
      spread(lab.at<cv::Vec3b>(y, x), [&](std::size_t cell, float weight) {
        if (common[cell] > 0)
          sum += weight * std::min(1.0f, look_->colours[cell] * area / common[cell]);
      });
      evidence.at<float>(y, x) = sum;
    }
  for (auto& box : taken) {
    ImageBox small{
      {box.center.x * factor, box.center.y * factor}, box.width * factor, box.height * factor};
    auto rect = pixels_of(small) & cv::Rect(0, 0, lab.cols, lab.rows);
    evidence(rect).setTo(0);
  }
  cv::Size window(std::max(1, cvRound(width * factor)), std::max(1, cvRound(height * factor)));
  cv::Mat sums;
  cv::boxFilter(evidence, sums, CV_32F, window, {-1, -1}, true, cv::BORDER_CONSTANT);
  constexpr int places = 5;
  std::optional<ImageBox> best;
  auto highest = least;
  for (int place = 0; place < places; ++place) {
    double value = 0;
    cv::Point at;
    cv::minMaxLoc(sums, nullptr, &value, nullptr, &at);
    if (value <= 0)
      break;
    // From there uphill, in ever smaller steps.
    ImageBox box{{at.x / factor, at.y / factor}, width, height};
    auto here = similarity(picture, box);
    for (double step = 0.25; step > 0.02; step /= 2)
      for (auto [dx, dy] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}}) {
        auto next = box;
        next.center.x += dx * step * width;
        next.center.y += dy * step * height;
        if (auto there = similarity(picture, next); there > here) {
          box = next;
          here = there;
        }
      }
    if (here >= highest) {
      highest = here;
      best = box;
    }
    auto seen = cv::Rect(at - cv::Point(window) / 2, window) & cv::Rect({0, 0}, sums.size());
    sums(seen).setTo(0);
  }
  return best;
}

} // namespace castor::vision
