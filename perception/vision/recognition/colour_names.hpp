#pragma once

#include <string>
#include <vector>

#include "castor/perception/vision/types.hpp"

namespace castor::vision {

/// Estimation of a surface's colour from its pixels. Brightness is the largest of B, G and R, gamma
/// encoded, in [0, 1].
struct ColourOptions {
  /// Range of the pixels used, as quantiles of brightness: without the shaded side and the
  /// highlights.
  double darkest = 0.3;
  double brightest = 0.9;
  /// Width of the border along the outline that is not used, because it is mixed with the ground;
  /// pixels.
  int rim = 2;
  /// Assumed brightnesses of the ground around the region (a grey floor, a tabletop, a sheet), from
  /// which the light is estimated. Which of them it is is not known: all count the same for names.
  std::vector<double> ground_brightness{0.55, 0.65, 0.75, 0.85, 0.95};
  /// Exponent of the shares of names, for each of these brightnesses. The shares say how many
  /// people use a name, but the confidence is how often a name is right: above 1, as the things on
  /// tables are of typical colours. Chosen so that names that are said of the tables of
  /// benchmarks/segmentation_benchmark with a confidence of 0.8 to 0.9 are right at least so often.
  /// Names that differ by their brightness alone, such as grey and white, count as one here.
  double typical_colours = 1.75;
  /// Ground darker than this (such as black velvet) is not used: the image is taken unchanged.
  double darkest_ground = 0.25;
  /// Colours are brightened at most by the reciprocal of this, nor so that the surface would be
  /// brighter than white.
  double min_light = 0.5;
  /// Differences between the channels of about this size (linear light) may be noise, or the colour
  /// of the light: they hardly count, so that what is black stays black.
  double least_chroma = 0.02;
  /// Colour of the ground, as saturation of the gamma encoded colour, that is its own; up to half
  /// of this it is the colour of the light, and the surface's colour is corrected for it.
  double coloured_ground = 0.3;
  /// Share of white light that a surface of any colour reflects specularly, which makes it paler
  /// than its paint. Glass and plastics (refractive index 1.5) reflect 0.04 of light at normal
  /// incidence and 0.09 of diffuse light, by Fresnel's equations.
  double gloss = 0.09;
  /// Maximum share of specular light in each of B, G and R.
  double max_gloss = 0.65;
};

/// The names that name_colour() may give.
const std::vector<std::string>& colour_vocabulary();

/// Names of the colour `bgr`, each channel in [0, 1] and gamma encoded as in sRGB: a confidence per
/// name of the vocabulary, in its order; they sum to 1. From the XKCD colour survey; see
/// scripts/derive-colour-table.
std::vector<double> colour_shares(const std::vector<double>& bgr);

/// Colour names of the surface in the region, the likeliest first; confidences sum to 1.
///
/// \param region the pixels of the region's box, 1 or 3 channels.
/// \param mask mask of the region: 1 channel, the same size, not 0 inside.
/// \returns nothing for an empty mask.
/// \throws std::invalid_argument unless both are images of the same size.
std::vector<Hypothesis> name_colour(const Image& region, const Image& mask,
                                    const ColourOptions& options = {});

/// Mean L*, a* and b* of the paint, over the pixels that name_colour() uses and for the middle one
/// of the assumed brightnesses of the ground; evidence for learned colour names.
///
/// \returns nothing for an empty mask.
/// \throws std::invalid_argument as name_colour() does.
std::vector<double> measure_colour(const Image& region, const Image& mask,
                                   const ColourOptions& options = {});

} // namespace castor::vision
