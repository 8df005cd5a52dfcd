#pragma once

#include "castor/perception/vision/segmentation/grid.hpp"
#include "castor/perception/vision/segmentation/segmentation_options.hpp"
#include "castor/perception/vision/types.hpp"

namespace castor::vision {

/// The preprocessed image that is segmented.
struct WorkingPicture {
  /// Working pixels per image pixel, at most 1.
  double scale = 1;
  /// Smoothed B, G, R in [0, 1], gamma encoded as they came.
  Grid<Colour> colour;
  /// The same as CIE L*a*b*.
  Grid<Colour> lab;
  /// Gradient of the colour; L*a*b* units per pixel.
  Grid<float> contrast;
  /// Contrasts below this are noise or shading.
  float flat_contrast = 0;
};

/// \throws std::invalid_argument if `image` has no pixels.
WorkingPicture make_working_picture(const Image& image, const SegmentationOptions& options);

/// Linear light from gamma encoded values; the square is near enough to the usual encodings to
/// compare hues.
inline Colour linear(const Colour& encoded) {
  return {encoded[0] * encoded[0], encoded[1] * encoded[1], encoded[2] * encoded[2]};
}

} // namespace castor::vision
