#include "castor/perception/vision/recognition/colour_names.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <utility>

#include <opencv2/imgproc.hpp>

#include "castor/perception/vision/opencv_bridge.hpp"

namespace castor::vision {

namespace {

constexpr int hues = 24;
constexpr int saturations = 6;
constexpr int value_steps = 6;
constexpr std::size_t name_count = 12;

using Shares = std::array<double, name_count>;

/// Percentages, by hue, saturation, value and name.
constexpr std::array<std::uint8_t, hues * saturations * value_steps * name_count> colour_table{
#include "castor/perception/vision/recognition/colour_table.inc"
};

/// The grid's nodes below and above a coordinate, and how much the latter counts.
struct Between {
  int below;
  int above;
  double weight;
};

/// \param position in [0, 1].
Between between(double position, int nodes) {
  const double scaled = std::clamp(position, 0.0, 1.0) * (nodes - 1);
  const int below = std::min(static_cast<int>(scaled), nodes - 2);
  return {below, below + 1, scaled - below};
}

Between between_hues(double sixths) {
  const double scaled = sixths / 6 * hues;
  const int below = static_cast<int>(scaled) % hues;
  return {below, (below + 1) % hues, scaled - std::floor(scaled)};
}

/// In sixths of the circle from red over green to blue.
double hue_of(double b, double g, double r, double value, double range) {
  if (range <= 0)
    return 0;
  if (value == r)
    return std::fmod((g - b) / range + 6, 6);
  if (value == g)
    return (b - r) / range + 2;
  return (r - g) / range + 4;
}

void add_node(Shares& shares, int hue, int saturation, int value, double weight) {
  const auto node =
    static_cast<std::size_t>((hue * saturations + saturation) * value_steps + value);
  for (std::size_t name = 0; name < name_count; ++name)
    shares[name] += weight * colour_table[node * name_count + name];
}

/// Trilinear interpolation in the table; sums to about 100.
Shares shares_of(double b, double g, double r) {
  const double value = std::max({b, g, r});
  const double range = value - std::min({b, g, r});
  const Between h = between_hues(hue_of(b, g, r, value, range));
  const Between s = between(value > 0 ? range / value : 0, saturations);
  const Between v = between(value, value_steps);
  Shares shares{};
  for (const auto& [hue, hue_weight] : {std::pair(h.below, 1 - h.weight), {h.above, h.weight}}) {
    for (const auto& [sat, sat_weight] : {std::pair(s.below, 1 - s.weight), {s.above, s.weight}}) {
      add_node(shares, hue, sat, v.below, hue_weight * sat_weight * (1 - v.weight));
      add_node(shares, hue, sat, v.above, hue_weight * sat_weight * v.weight);
    }
  }
  return shares;
}

/// \pre `values` is not empty.
double quantile(std::vector<double>& numbers, double share) {
  const auto last = static_cast<double>(numbers.size() - 1);
  const auto place = numbers.begin() + std::lround(share * last);
  std::nth_element(numbers.begin(), place, numbers.end());
  return *place;
}

double brightness(const cv::Vec3b& pixel) {
  return std::max({pixel[0], pixel[1], pixel[2]}) / 255.0;
}

constexpr double gamma_exponent = 2.2;

cv::Vec3d to_light(const cv::Vec3d& encoded) {
  cv::Vec3d light;
  for (int c = 0; c < 3; ++c)
    light[c] = std::pow(encoded[c], gamma_exponent);
  return light;
}

/// What is around a region.
struct Surroundings {
  /// Its median brightness; nothing if there is none, or if it is too dark to tell.
  std::optional<double> level;
  /// Colour of the light, as far as it can be told: linear, the strongest channel is 1.
  cv::Vec3d light = cv::Vec3d::all(1);
};

Surroundings surroundings_of(const cv::Mat_<cv::Vec3b>& pixels, const cv::Mat_<std::uint8_t>& mask,
                             const ColourOptions& options) {
  std::array<std::vector<double>, 3> channels;
  std::vector<double> levels;
  for (int y = 0; y < pixels.rows; ++y) {
    for (int x = 0; x < pixels.cols; ++x) {
      if (mask(y, x) != 0)
        continue;
      levels.push_back(brightness(pixels(y, x)));
      for (int c = 0; c < 3; ++c)
        channels[static_cast<std::size_t>(c)].push_back(pixels(y, x)[c] / 255.0);
    }
  }
  Surroundings result;
  if (levels.empty())
    return result;
  const double level = quantile(levels, 0.5);
  if (level < options.darkest_ground)
    return result;
  result.level = level;
  const cv::Vec3d colour(quantile(channels[0], 0.5), quantile(channels[1], 0.5),
                         quantile(channels[2], 0.5));
  const double most = std::max({colour[0], colour[1], colour[2]});
  const double saturation = 1 - std::min({colour[0], colour[1], colour[2]}) / most;
  // The more colour a ground has, the likelier it is its own and not the light's.
  const double share =
    std::clamp((options.coloured_ground - saturation) / (options.coloured_ground / 2), 0.0, 1.0);
  const cv::Vec3d light = to_light(colour / most);
  for (int c = 0; c < 3; ++c)
    result.light[c] = std::pow(light[c], share);
  return result;
}

/// The light that the paint itself sends back, in [0, 1] of white; gamma encoded before and after.
///
/// \param white how bright white would be in this light.
/// \param tint the light's colour.
cv::Vec3d paint(const cv::Vec3b& pixel, double white, const cv::Vec3d& tint,
                const ColourOptions& options) {
  cv::Vec3d light = to_light(cv::Vec3d(pixel[0], pixel[1], pixel[2]) / (255 * white));
  for (int c = 0; c < 3; ++c)
    light[c] /= tint[c];
  const double most = std::max({light[0], light[1], light[2]});
  const double least = std::min({light[0], light[1], light[2]});
  // As N. Wiener's filter keeps of a signal in noise.
  const double signal = std::pow(most - least, 2);
  const double kept = signal / (signal + std::pow(options.least_chroma, 2));
  for (int c = 0; c < 3; ++c)
    light[c] = most - kept * (most - light[c]);
  const double gloss =
    std::min(options.gloss, options.max_gloss * std::min({light[0], light[1], light[2]}));
  for (int c = 0; c < 3; ++c)
    light[c] = (light[c] - gloss) / (1 - gloss);
  // Too bright ones keep their hue.
  const double scale = std::max(1.0, std::max({light[0], light[1], light[2]}));
  for (int c = 0; c < 3; ++c)
    light[c] = std::pow(light[c] / scale, 1 / gamma_exponent);
  return light;
}

/// The mask without its rim, unless nothing would remain.
cv::Mat_<std::uint8_t> inner(const cv::Mat_<std::uint8_t>& mask, int rim) {
  cv::Mat_<std::uint8_t> framed;
  cv::copyMakeBorder(mask, framed, 1, 1, 1, 1, cv::BORDER_CONSTANT, 0);
  cv::Mat distance;
  cv::distanceTransform(framed, distance, cv::DIST_L2, 3);
  double deepest = 0;
  cv::minMaxLoc(distance, nullptr, &deepest);
  const double depth = std::min(static_cast<double>(rim), deepest / 2);
  const cv::Rect whole(1, 1, mask.cols, mask.rows);
  cv::Mat_<std::uint8_t> result;
  cv::compare(distance(whole), depth, result, cv::CMP_GT);
  return result;
}

/// The pixels of a surface that count, and how bright white may be in their light.
struct SurfacePixels {
  std::vector<cv::Vec3b> pixels;
  std::vector<double> whites;
  cv::Vec3d tint = cv::Vec3d::all(1);
};

/// No pixels for an empty mask.
SurfacePixels surface_pixels(const Image& region, const Image& mask, const ColourOptions& options) {
  if (mask.channels != 1 || mask.width != region.width || mask.height != region.height)
    throw std::invalid_argument("the mask must have 1 channel and the region's size");
  cv::Mat_<cv::Vec3b> pixels;
  if (region.channels == 1)
    cv::cvtColor(as_mat(region), pixels, cv::COLOR_GRAY2BGR);
  else
    pixels = as_mat(region);
  const cv::Mat_<std::uint8_t> belongs = as_mat(mask);
  if (pixels.empty() || cv::countNonZero(belongs) == 0)
    return {};
  const cv::Mat_<std::uint8_t> counts = inner(belongs, options.rim);
  std::vector<cv::Vec3b> all;
  std::vector<double> levels;
  for (int y = 0; y < pixels.rows; ++y) {
    for (int x = 0; x < pixels.cols; ++x) {
      if (counts(y, x) != 0) {
        all.push_back(pixels(y, x));
        levels.push_back(brightness(pixels(y, x)));
      }
    }
  }
  const double darkest = quantile(levels, options.darkest);
  const double brightest = quantile(levels, options.brightest);
  SurfacePixels surface;
  for (const auto& pixel : all) {
    const double level = brightness(pixel);
    if (level >= darkest && level <= brightest)
      surface.pixels.push_back(pixel);
  }
  const auto around = surroundings_of(pixels, belongs, options);
  surface.tint = around.light;
  // No paint is brighter than white.
  const double least = std::min(1.0, std::max(options.min_light, brightest));
  for (const double assumed : options.ground_brightness)
    surface.whites.push_back(around.level ? std::clamp(*around.level / assumed, least, 1.0) : 1.0);
  return surface;
}

/// By name: those of one family, orange and brown, or grey and white, differ by their
/// brightness alone.
constexpr std::array<std::size_t, name_count> families{0, 1, 2, 3, 4, 5, 6, 7, 1, 8, 9, 8};

/// Adds the powers of the shares that families have of the votes, scaled so that they sum to 1. How
/// bright a surface would be in white light is not known so well: within a family, the shares stay.
void add_confidences(const Shares& votes, double exponent, Shares& confidences) {
  Shares of_family{};
  for (std::size_t name = 0; name < name_count; ++name)
    of_family[families[name]] += votes[name];
  const double most = *std::max_element(of_family.begin(), of_family.end());
  Shares powers{};
  double sum = 0;
  for (std::size_t name = 0; name < name_count; ++name) {
    const double family = of_family[families[name]];
    if (family > 0)
      powers[name] = std::pow(family / most, exponent) * votes[name] / family;
    sum += powers[name];
  }
  for (std::size_t name = 0; name < name_count && sum > 0; ++name)
    confidences[name] += powers[name] / sum;
}

} // namespace

const std::vector<std::string>& colour_vocabulary() {
  static const std::vector<std::string> vocabulary{"red",   "orange", "yellow", "green",
                                                   "cyan",  "blue",   "purple", "pink",
                                                   "brown", "grey",   "black",  "white"};
  return vocabulary;
}

std::vector<double> colour_shares(const std::vector<double>& bgr) {
  if (bgr.size() != 3)
    throw std::invalid_argument("colour_shares: a colour is blue, green and red");
  const Shares shares = shares_of(bgr[0], bgr[1], bgr[2]);
  double sum = 0;
  for (const double share : shares)
    sum += share;
  std::vector<double> result(shares.begin(), shares.end());
  for (double& share : result)
    share /= sum;
  return result;
}

std::vector<Hypothesis> name_colour(const Image& region, const Image& mask,
                                    const ColourOptions& options) {
  // So many pixels say as much as all of them.
  constexpr std::size_t enough = 300;
  const SurfacePixels surface = surface_pixels(region, mask, options);
  if (surface.pixels.empty())
    return {};
  const std::size_t stride = surface.pixels.size() / enough + 1;
  Shares confidences{};
  for (const double white : surface.whites) {
    Shares votes{};
    for (std::size_t i = 0; i < surface.pixels.size(); i += stride) {
      const cv::Vec3d colour = paint(surface.pixels[i], white, surface.tint, options);
      const Shares shares = shares_of(colour[0], colour[1], colour[2]);
      for (std::size_t name = 0; name < name_count; ++name)
        votes[name] += shares[name];
    }
    add_confidences(votes, options.typical_colours, confidences);
  }
  double sum = 0;
  for (const double confidence : confidences)
    sum += confidence;
  std::vector<Hypothesis> result;
  for (std::size_t name = 0; name < name_count; ++name) {
    if (confidences[name] > 0)
      result.push_back({colour_vocabulary()[name], confidences[name] / sum});
  }
  std::stable_sort(result.begin(), result.end(), [](const Hypothesis& a, const Hypothesis& b) {
    return a.confidence > b.confidence;
  });
  return result;
}

std::vector<double> measure_colour(const Image& region, const Image& mask,
                                   const ColourOptions& options) {
  const SurfacePixels surface = surface_pixels(region, mask, options);
  if (surface.pixels.empty() || surface.whites.empty())
    return {};
  std::vector<cv::Vec3d> colours;
  for (const auto& pixel : surface.pixels)
    colours.push_back(
      paint(pixel, surface.whites[surface.whites.size() / 2], surface.tint, options));
  cv::Mat bgr;
  cv::Mat(colours).convertTo(bgr, CV_32F);
  cv::Mat lab;
  cv::cvtColor(bgr, lab, cv::COLOR_BGR2Lab);
  const auto mean = cv::mean(lab);
  return {mean[0], mean[1], mean[2]};
}

} // namespace castor::vision
