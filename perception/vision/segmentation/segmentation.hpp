#pragma once

#include <vector>

#include "castor/perception/vision/segmentation/background_model.hpp"
#include "castor/perception/vision/segmentation/segmentation_options.hpp"
#include "castor/perception/vision/types.hpp"

namespace castor::vision {

/// A part of an image that differs from the ground: probably an object.
struct Segment {
  ImageBox box;
  /// Mask of the segment within `box`: 1 channel, 0 or 255.
  Image mask;
  /// The outline, clockwise or anticlockwise, in image coordinates.
  std::vector<Point2> contour;
};

/// Does what the first call of `segment` would do otherwise: calculates tables of colours, which
/// take as long as some ten pictures, and uses code and memory for the first time.
void prepare_segmentation();

/// Finds the segments of an image, from the top down.
///
/// Contrast divides the image into areas (a watershed, then joining across weak boundaries). The
/// area that holds most of the image's border is ground, and so is any other that is as wide, or
/// that is large unless the ground goes around it and nothing else is on it. The ground's colour is
/// interpolated below all other areas, so that shading, shadows and the hues of objects are
/// compared with the ground at the same place. Other areas are joined to objects where hue agrees
/// (a surface keeps its hue in light and shade) and where the union is convex, except for what
/// hides behind other objects. What is of one colour is divided again where its outline has a neck
/// between two convex parts. Shadows are ground.
///
/// If the area that would be ground is not of one colour, texture hides the edges, and the image is
/// divided anew as a close-up. Then only the area that holds most of the border is ground, and if
/// none does, all large areas are objects.
///
/// \param background the empty scene, or null: then all pixels that look like it are ground, and
/// objects may cover most of the image.
/// \throws std::invalid_argument if the image has no pixels, or is not of the background's size.
std::vector<Segment> segment(const Image& image, const SegmentationOptions& options = {},
                             const BackgroundModel* background = nullptr);

} // namespace castor::vision
