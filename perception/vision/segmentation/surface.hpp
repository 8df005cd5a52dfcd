#pragma once

#include "castor/perception/vision/segmentation/area_graph.hpp"

namespace castor::vision {

/// The colour of an area relative to the ground around it. Shading moves the colour along a ray
/// from black, specular light moves it towards the ground's own hue; the direction away from that
/// hue is invariant.
struct Surface {
  /// Angle between the colour and the ground's; degrees.
  double angle = 0;
  /// The part of the unit colour vector that is orthogonal to the ground's.
  ColourSum offset{};
  /// Relative to the ground, on a gamma encoded scale.
  double brightness = 0;
};

Surface surface_of(const Area& area);

/// Angle between the ground's colour at the area and white; degrees.
double ground_colourfulness(const Area& area);

/// Difference of two surfaces in degrees; differences in the angle to the ground's colour have the
/// weight `saturation_weight`.
double surface_difference(const Surface& a, const Surface& b, double saturation_weight);

/// Difference of the mean colours; L*a*b* units.
double lab_difference(const Area& a, const Area& b);

/// Difference of the mean colours without lightness; a* and b* units.
double chroma_difference(const Area& a, const Area& b);

/// Difference of the area from the ground at its place; L*a*b* units.
double ground_difference(const Area& area);

/// The standard deviation of the colours within an area; L*a*b* units.
double colour_spread(const Area& area, const Grid<Colour>& lab);

/// How unevenly an area is lit, as the range of the middle half of its pixels' shades; near 0 for a
/// piece of the ground in less light.
double shade_range(const Area& area, const Grid<float>& shade);

/// The first and the last row of an area.
struct Extent {
  int top = 0;
  int bottom = 0;
};

/// \param width of the picture, pixels.
Extent extent_of(const Area& area, int width);

/// The share of an area that its largest inscribed disc fills: 1 for a disc, near 0 for a line.
double compactness(const Area& area, int width);

} // namespace castor::vision
