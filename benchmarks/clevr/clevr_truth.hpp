#pragma once

#include <opencv2/core.hpp>

#include "castor/benchmarks/clevr/clevr_scenes.hpp"
#include "castor/perception/vision/types.hpp"

namespace castor::clevr {

/// Ground truth of the visible objects, from the scene graph: a label image with the index of the
/// object, -1 where there is none. Edges are sharp here and slightly rounded in the images.
///
/// \param camera in CLEVR's units.
cv::Mat_<int> visible_objects(const Scene& scene, const geometry::Camera& camera, cv::Size size);

} // namespace castor::clevr
