#pragma once

#include <span>
#include <string>
#include <vector>

#include "castor/perception/vision/types.hpp"

namespace castor::vision {

/// Names of the measurements for shape classification, in the order of measure_shape().
///
/// Lengths are relative to the radius of the disc of the region's area, so that size does not
/// matter; directions are kept, for things stand upright:
///   support_N    how far the outline reaches from the centroid, in 24 directions, anticlockwise
///                from the right
///   solidity     the region's share of its convex hull
///   ellipse      the overlap (intersection by union) with the ellipse of the same second moments
///   rectangle    the region's share of the smallest rectangle around it, at any angle
///   triangle     the same for the smallest triangle
///   corners_N    a fifth of the corners of the outline, when simplified with 4 and 8 % tolerance
///   light_N      brightness in the cells of a 4 x 4 grid over the box, in units of its mean, less
///                1; 0 for cells out of the region
///   variation    the standard deviation of brightness, in units of its mean
///   step_N       the largest step between adjacent columns (of 8) of the upper and of the lower
///                half, and between adjacent rows, in units of the mean brightness
///   smooth_N     the share that this step has in all the steps there
///   fit_measurements() follow
const std::vector<std::string>& shape_measurements();

/// Measures a region; one number per name of shape_measurements(), all finite.
///
/// \param region the pixels of the region's box, 1 or 3 channels.
/// \param mask mask of the region: 1 channel, the same size, not 0 inside.
/// \param fit from measure_fit(); if empty, as where the camera is not known, all 0.
/// \returns empty if the mask has fewer than 12 pixels, or all on a line.
/// \throws std::invalid_argument unless both are images of the same size, and `fit` has as many
///         numbers as there are fit_measurements().
std::vector<double> measure_shape(const Image& region, const Image& mask,
                                  std::span<const double> fit = {});

} // namespace castor::vision
