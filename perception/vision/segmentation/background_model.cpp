#include "castor/perception/vision/segmentation/background_model.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace castor::vision {

namespace {

Colour pixel(const Image& image, int cell) {
  const auto* bytes = image.bytes.data() + static_cast<std::size_t>(cell) * image.channels;
  if (image.channels == 1)
    return {static_cast<float>(bytes[0]), static_cast<float>(bytes[0]),
            static_cast<float>(bytes[0])};
  return {static_cast<float>(bytes[0]), static_cast<float>(bytes[1]), static_cast<float>(bytes[2])};
}

void check(const Image& image) {
  const auto expected = static_cast<std::size_t>(image.width) * image.height * image.channels;
  if ((image.channels != 1 && image.channels != 3) || expected == 0 ||
      image.bytes.size() != expected)
    throw std::invalid_argument("BackgroundModel: not an image");
}

} // namespace

BackgroundModel::BackgroundModel(BackgroundOptions options) : options_(options) {
  // nop
}

void BackgroundModel::learn(const Image& image) {
  check(image);
  const auto image_width = static_cast<int>(image.width);
  const auto image_height = static_cast<int>(image.height);
  if (images_ == 0) {
    mean_ = Grid<Colour>(image_width, image_height);
    spread_ = Grid<Colour>(image_width, image_height);
  } else if (image_width != width() || image_height != height()) {
    throw std::invalid_argument("BackgroundModel::learn: the image is not of the size of those "
                                "before");
  }
  ++images_;
  const auto count = static_cast<float>(images_);
  for (int cell = 0; cell < mean_.size(); ++cell) {
    const Colour value = pixel(image, cell);
    for (std::size_t c = 0; c < value.size(); ++c) {
      // Welford's recurrence.
      const float before = value[c] - mean_[cell][c];
      mean_[cell][c] += before / count;
      spread_[cell][c] += before * (value[c] - mean_[cell][c]);
    }
  }
}

Grid<std::uint8_t> BackgroundModel::foreground(const Image& image) const {
  check(image);
  if (images_ == 0)
    throw std::invalid_argument("BackgroundModel::foreground: nothing was learned yet");
  if (static_cast<int>(image.width) != width() || static_cast<int>(image.height) != height())
    throw std::invalid_argument(
      "BackgroundModel::foreground: the image is not of the size of those "
      "learned from");
  Grid<std::uint8_t> result(width(), height());
  const double cos_shadow = std::cos(options_.shadow_angle * std::numbers::pi / 180);
  for (int cell = 0; cell < mean_.size(); ++cell) {
    const Colour value = pixel(image, cell);
    const Colour& mean = mean_[cell];
    bool differs = false;
    double dot = 0;
    double value_square = 0;
    double mean_square = 0;
    for (std::size_t c = 0; c < value.size(); ++c) {
      const double variance = static_cast<double>(spread_[cell][c]) / std::max(1, images_ - 1);
      const double deviation = std::max(options_.min_deviation, std::sqrt(variance));
      differs = differs || std::abs(value[c] - mean[c]) > options_.deviations * deviation;
      dot += static_cast<double>(value[c]) * mean[c];
      value_square += static_cast<double>(value[c]) * value[c];
      mean_square += static_cast<double>(mean[c]) * mean[c];
    }
    const bool darker =
      value_square < mean_square && dot >= options_.shadow_brightness * mean_square;
    const bool same_hue = dot >= cos_shadow * std::sqrt(value_square * mean_square);
    result[cell] = differs && !(darker && same_hue) ? 255 : 0;
  }
  return result;
}

} // namespace castor::vision
