#pragma once

#include <cstdint>

#include "castor/perception/vision/segmentation/grid.hpp"

namespace castor::vision {

/// Continues the colours of the `known` pixels (those that are not 0) smoothly across all others.
///
/// Pull and push: means over ever larger blocks, of which each pixel takes the finest that holds
/// enough known pixels. All zero if nothing is known.
Grid<Colour> interpolate(const Grid<Colour>& colours, const Grid<std::uint8_t>& known);

} // namespace castor::vision
