#pragma once

#include <vector>

#include "castor/perception/vision/segmentation/segmentation.hpp"

namespace castor::vision {

/// What is too small to be an object.
struct SizeLimits {
  /// Share of the image; 0: `min_length` where the camera is calibrated, else
  /// SegmentationOptions::min_pixels.
  double min_area = 0;
  /// Minimum of the longest side on the table; metres.
  double min_length = 0.008;
  /// With `min_length`: minimum number of pixels in the working image, for what the table's far end
  /// shows of a thing.
  int min_pixels = 20;
};

/// The segments of an image of a table, by segment() and within the limits.
///
/// \param camera that has taken the image; null if it is unknown. One that is assumed is not
/// calibrated.
/// \throws std::invalid_argument as segment() does.
std::vector<Segment> segment_table(const Image& image, const Camera* camera,
                                   const SizeLimits& limits = {}, SegmentationOptions options = {},
                                   const BackgroundModel* background = nullptr);

} // namespace castor::vision
