#pragma once

#include "castor/perception/vision/segmentation/area_graph.hpp"
#include "castor/perception/vision/segmentation/background_model.hpp"
#include "castor/perception/vision/segmentation/segmentation_options.hpp"

namespace castor::vision {

/// Joins areas across boundaries of at most `max_contrast`, the weakest first; beyond
/// `clear_contrast` only those that do not differ in hue.
void join_weak(AreaGraph& graph, double max_contrast, double clear_contrast,
               const SegmentationOptions& options);

/// The area that holds most of the image's border.
int widest_on_border(const AreaGraph& graph);

/// Joins all ground areas into one and sets it as the graph's ground.
void join_ground(AreaGraph& graph, const SegmentationOptions& options);

/// Likewise, where the ground is known: areas most of whose pixels are 0 in `foreground`.
void join_ground(AreaGraph& graph, const Grid<std::uint8_t>& foreground);

/// Joins areas to objects and shadows to the ground; the graph must know the ground and its
/// colours.
void group(AreaGraph& graph, const SegmentationOptions& options);

/// Joins crumbs and insets to the areas that they are on, in pictures without ground.
void group_without_ground(AreaGraph& graph, const SegmentationOptions& options);

} // namespace castor::vision
