#pragma once

#include <map>
#include <string>
#include <vector>

#include "castor/perception/vision/types.hpp"

namespace castor::vision {

/// Names of the measurements of measure_fit(), in its order:
///   fit_NAME       how far the outline is from that of a thing of this shape at this place: the
///                  natural logarithm of the deviation of their supports in 24 directions, in
///                  hundredths of the radius of the disc of the region's area. Place in the image
///                  and size are free, and directions in which they do not agree at all (a
///                  neighbour hides the thing, or was taken for a part of it) count only so much.
///   sure_fit       how much better the best solid fits than the next one, as the difference of
///                  the logarithms
///   faces_NAME     share of the variance of brightness that is between the faces of the cube (of
///                  the cylinder) that fits best
///   edge_upright   step of brightness across the upright edge between two faces of that cube, in
///                  units of the region's mean; 0 if only one side is in view
///   sharp_upright  share of this step in that across a strip three times as wide
///   edge_rim       the same step across the edges around the cube's top, and
///   edge_round     across the front of the rim of the cylinder's top
///   seen           1; it is 0 where nothing is measured
const std::vector<std::string>& fit_measurements();

/// Compares the outline of a region with those that a cube, a cylinder, a sphere, a flat disc and a
/// flat square would have in the image if they were at this place on the table; turned, and
/// cylinders high, as suits best.
///
/// \param roi its box, pixels, mask and contour.
/// \returns all 0 if the region's foot is not on the visible table.
std::vector<double> measure_fit(const ROI& roi, const Camera& camera);

/// How far the outline is from the one that a cube, a cylinder, a sphere, a flat circle or a flat
/// square would have at this place on the table, at best: the robust mean, in units of the radius
/// of the disc of the region's area. Cylinders are half as high as wide to 2.4 times.
///
/// \returns nothing if the region's foot is not on the visible table.
std::map<std::string, double> outline_deviations(const ROI& roi, const Camera& camera);

} // namespace castor::vision
