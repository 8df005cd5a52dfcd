#pragma once

#include <span>
#include <string>
#include <vector>

#include "castor/perception/vision/recognition/colour_names.hpp"
#include "castor/perception/vision/recognition/shape_classifier.hpp"
#include "castor/perception/vision/recognition/size_on_table.hpp"
#include "castor/perception/vision/segmentation/background_model.hpp"
#include "castor/perception/vision/segmentation/segmentation.hpp"
#include "castor/perception/vision/types.hpp"

namespace castor::vision {

/// Options of all steps from an image to recognised regions.
struct RegionOptions {
  SegmentationOptions segmentation;
  ColourOptions colour;
  ShapeOptions shape;
  SizeOptions size;
};

/// The region of interest of a segment of `image`, without features.
/// \throws std::invalid_argument if the segment's box is not within the image.
ROI make_roi(const Image& image, const Segment& segment);

/// Measures the features of a region. The extent is all zero without a camera, or if the region is
/// not on the visible table. Without a camera, or with an assumed one, a ball and a disc are not
/// told apart.
RegionFeatures measure_region(const ROI& roi, const Camera* camera = nullptr,
                              const RegionOptions& options = {},
                              const ShapeNetwork& network = trained_shape_network());

/// The best of ranked hypotheses; "unknown" with confidence 0 if there are none.
Hypothesis best_of(std::span<const Hypothesis> ranked);

/// A region with the hypotheses about it.
struct Region {
  ROI roi;
  Hypothesis colour;
  Hypothesis shape;
  /// "unknown" without a camera.
  Hypothesis size;
};

/// All steps: segments `image`, measures the regions and recognises them.
/// \throws std::invalid_argument as segment() does.
std::vector<Region> find_regions(const Image& image, const Camera* camera = nullptr,
                                 const RegionOptions& options = {},
                                 const BackgroundModel* background = nullptr,
                                 const ShapeNetwork& network = trained_shape_network());

} // namespace castor::vision
