#pragma once

#include <random>

#include <opencv2/core.hpp>

#include "castor/perception/vision/types.hpp"

namespace castor::clevr {

/// The region as a less lucky segmentation would have found it: cut off by a neighbour, with a
/// piece of the surroundings (a shadow, a reflection), or with its outline a pixel off.
///
/// \param image what the region was found in.
/// \returns a region without pixels if nothing of it is left.
vision::ROI damaged(const vision::ROI& region, const vision::Image& image, std::mt19937& random);

} // namespace castor::clevr
