#pragma once

#include "castor/perception/vision/segmentation/grid.hpp"

namespace castor::vision {

/// A division of an image: every pixel's area, 0 to count - 1.
struct Division {
  Grid<int> area;
  int count = 0;
};

/// Watershed transform: the basins of `contrast`, flooded from its local minima.
///
/// Heights are counted in 256 steps of `step` above `flat`, so that a connected flat area is one
/// basin. The order of flooding follows F. Meyer, "Topographic distance and watershed lines", 1994,
/// without lines between the basins.
Division watershed(const Grid<float>& contrast, float flat, float step);

} // namespace castor::vision
