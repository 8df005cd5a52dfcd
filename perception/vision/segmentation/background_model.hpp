#pragma once

#include "castor/perception/vision/segmentation/grid.hpp"
#include "castor/perception/vision/types.hpp"

namespace castor::vision {

/// Options for the difference of a pixel from the background.
struct BackgroundOptions {
  /// Minimum difference, in standard deviations of the pixel in the learned images, per channel.
  double deviations = 4.0;
  /// Lower bound of standard deviations, of 255: cameras quantise, lamps flicker.
  double min_deviation = 3.0;
  /// A pixel of the background's chromaticity that is darker, but keeps at least this share of its
  /// brightness, lies in a shadow. 1: there are no shadows.
  double shadow_brightness = 0.5;
  /// How far the chromaticity of a shadow may differ; degrees between (B, G, R) vectors.
  double shadow_angle = 4.0;
};

/// Appearance of the empty scene: mean and variance per pixel over a sequence of images.
///
/// The distinction of brightness and chromaticity is that of T. Horprasert, D. Harwood and L.
/// Davis, "A statistical approach for real-time robust background subtraction and shadow
/// detection", 1999.
class BackgroundModel {
public:
  explicit BackgroundModel(BackgroundOptions options = {});

  /// Learns from one more image of the background.
  /// \throws std::invalid_argument if the image has no pixels, or is not of the same size as those
  /// before.
  void learn(const Image& image);

  /// The number of images learned from.
  int images() const { return images_; }
  int width() const { return mean_.width(); }
  int height() const { return mean_.height(); }

  /// The mean image, 0 to 255.
  const Grid<Colour>& mean() const { return mean_; }

  /// Mask: 255 where `image` differs from the background, else 0.
  /// \throws std::invalid_argument if nothing was learned, or the image is not of the same size.
  Grid<std::uint8_t> foreground(const Image& image) const;

private:
  BackgroundOptions options_;
  int images_ = 0;
  Grid<Colour> mean_;
  /// Sums of squared deviations from the mean.
  Grid<Colour> spread_;
};

} // namespace castor::vision
