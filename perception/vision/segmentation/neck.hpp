#pragma once

#include <vector>

#include "castor/perception/vision/segmentation/segmentation_options.hpp"

namespace castor::vision {

/// Divides the area of things of one colour that touch each other, by its shape alone: along the
/// shortest line between two inward corners of its outline, if that is a neck, and as long as the
/// parts on both sides are convex, which the whole is not. One thing, or none of whose sides is a
/// thing, stays whole.
///
/// \param cells of the area: y * width + x.
/// \param width of the picture, pixels.
/// \return the parts, at least one; each cell is in one of them.
std::vector<std::vector<int>> divide_at_necks(const std::vector<int>& cells, int width,
                                              const NeckOptions& options = {});

} // namespace castor::vision
