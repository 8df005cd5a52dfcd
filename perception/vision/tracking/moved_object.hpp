#pragma once

#include "castor/perception/vision/types.hpp"

namespace castor::vision {

/// Moves a region to the foot of `box`, and the object of the region by the same vector on the
/// table. Sizes and pixels are kept. If the foot is not on the table, only the region is moved.
void move_to(const ImageBox& box, const Camera& camera, ROI& roi, SceneObject& object);

} // namespace castor::vision
