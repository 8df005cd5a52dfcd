#pragma once

#include <string>
#include <vector>

#include "castor/perception/vision/types.hpp"

namespace castor::vision {

/// How the colour of a surface is told from its pixels. Brightness is the largest of B, G and R,
/// gamma encoded, in [0, 1].
struct ColourOptions {
  /// The pixels that count, as quantiles of brightness: not the shaded side, not the highlights.
  double darkest = 0.3;
  double brightest = 0.9;
  /// Pixels this near to the outline do not count: they are mixed with the ground. Pixels.
  int rim = 2;
  /// The ground around the region tells the light: a tabletop or a sheet is taken for this bright.
  double ground_brightness = 0.78;
  /// Unless it is darker than this: black velvet tells nothing, the image is taken as it is.
  double darkest_ground = 0.25;
  /// However dim the ground, colours are never made brighter than by the reciprocal of this.
  double min_light = 0.5;
  /// The share of white light that any surface mirrors, whatever its colour: it looks paler than
  /// its paint. Glass and plastics (refractive index 1.5) mirror 0.04 of the light that falls
  /// straight on them and 0.09 of light from all around, by Fresnel's equations.
  double gloss = 0.09;
  /// But no more than this share of what is there of each of B, G and R can be mirrored light.
  double max_gloss = 0.65;
};

/// The names that name_colour() may give.
const std::vector<std::string>& colour_vocabulary();

/// What people call the colour `bgr`, each channel in [0, 1] and gamma encoded as in sRGB: a
/// confidence per name of the vocabulary, in its order; they sum to 1. From the XKCD colour survey;
/// see scripts/derive-colour-table.
std::vector<double> colour_shares(const std::vector<double>& bgr);

/// What colour the surface in the region has, the likeliest name first; confidences sum to 1.
///
/// \param region the pixels of the region's box, 1 or 3 channels.
/// \param mask which of them are the region's: 1 channel, the same size, not 0 where they are.
/// \returns nothing for an empty mask.
/// \throws std::invalid_argument unless both are images of the same size.
std::vector<Hypothesis> name_colour(const Image& region, const Image& mask,
                                    const ColourOptions& options = {});

/// What its paint measures: the mean L*, a* and b* of the pixels by which name_colour() judges, for
/// those who have names of their own.
///
/// \returns nothing for an empty mask.
/// \throws std::invalid_argument as name_colour() does.
std::vector<double> measure_colour(const Image& region, const Image& mask,
                                   const ColourOptions& options = {});

} // namespace castor::vision
