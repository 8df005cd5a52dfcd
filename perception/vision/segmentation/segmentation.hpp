#pragma once

#include <vector>

#include "castor/perception/vision/segmentation/background_model.hpp"
#include "castor/perception/vision/segmentation/segmentation_options.hpp"
#include "castor/perception/vision/types.hpp"

namespace castor::vision {

/// A part of an image in which something stands out from the ground.
struct Segment {
  ImageBox box;
  /// Which pixels of `box` belong to the segment: 1 channel, 0 or 255.
  Image mask;
  /// The outline, clockwise or anticlockwise, in image coordinates.
  std::vector<Point2> contour;
};

/// What stands out in `image`, from the top down.
///
/// Contrast divides the image into areas (a watershed, then joining across weak boundaries). The
/// area that holds most of the image's border, and any other that is as large or as wide as that,
/// is ground. The ground's colour is interpolated below all the others, so that its shading, its
/// shadows and the hues of things are judged against the ground right there. Other areas are joined
/// to objects where hue agrees (a surface keeps its hue in light and shade) and where the union is
/// convex, except for what hides behind other objects.
///
/// If the area that would be ground is not of one colour, texture has drowned the edges, and the
/// image is divided anew as a close-up. Then ground is only what holds most of the border, and if
/// nothing does, all large areas are objects.
///
/// \param background what the place looks like with nothing on it, if that is known: then ground is
/// what looks like that, at any size, and objects may even be the larger part of the image.
/// \throws std::invalid_argument if the image is none, or not of the background's size.
std::vector<Segment> segment(const Image& image, const SegmentationOptions& options = {},
                             const BackgroundModel* background = nullptr);

} // namespace castor::vision
