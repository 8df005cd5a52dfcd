#pragma once

#include "castor/perception/vision/types.hpp"

namespace castor::vision {

/// Moves a region, and the object that it is a view of, so that the foot of the region's box is
/// that of `box`: both by the same way on the table. Sizes stay what they were, and so do the
/// pixels, which show the thing as it was. Where the foot is not seen on the table, only the region
/// moves.
void move_to(const ImageBox& box, const Camera& camera, ROI& roi, SceneObject& object);

} // namespace castor::vision
