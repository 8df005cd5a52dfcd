#pragma once

#include <cstddef>

namespace castor::vision {

/// Options for close-ups, in which textured objects fill the frame: the image is shrunk until their
/// texture vanishes, and only large areas count.
struct CloseUpOptions {
  /// See SegmentationOptions.
  int working_side = 128;
  double smoothing = 1.5;
  double noise_factor = 1.0;
  double edge_factor = 2.2;
  /// An area with a larger share of the image's border than this is the ground; without one, all
  /// areas are things.
  double ground_border = 0.5;
  /// As in SegmentationOptions; most things in a close-up are large and many are cut off.
  double min_area = 0.02;
  double max_area = 0.7;
  double max_cut_area = 0.7;
  double max_border = 0.45;
};

/// Options for dividing an area at its necks; pixels are those of the working image, and solidity
/// is the share of its convex hull that an area fills.
struct NeckOptions {
  /// Areas of more solidity are one thing.
  double convex = 0.94;
  /// Outlines are straightened by up to this; pixels.
  double tolerance = 1.5;
  /// An inward corner turns by at least this; degrees. Outlines with more such corners are not of
  /// things that touch each other.
  double min_turn = 20;
  std::size_t max_corners = 12;
  /// Minimum of a part: pixels, share of the whole, solidity.
  int min_pixels = 40;
  double min_share = 0.12;
  double min_solidity = 0.9;
  /// A neck is at most this long, as a share of the width of the narrower part.
  double max_length = 0.8;
  /// Share that the parts leave of the space that the whole leaves in its hull.
  double max_rest = 0.45;
};

/// Options of the segmentation. Contrasts are CIE L*a*b* units per pixel of the smoothed working
/// image, with a* and b* stretched by `chroma_weight`; angles are degrees between linear (B, G, R)
/// vectors; areas are shares of the image unless they say pixels.
struct SegmentationOptions {
  /// Maximum length of the longer side; larger images are shrunk; pixels.
  int working_side = 512;
  /// The Gaussian that the working image is smoothed with; its sigma, pixels.
  double smoothing = 1.0;
  double chroma_weight = 1.5;
  /// Contrasts below this are flat ground; raised to `noise_factor` times the image's median
  /// contrast where that is more.
  double flat_contrast = 1.2;
  double noise_factor = 3.0;
  /// Two areas are one while their mean contrast along the common boundary is below this multiple
  /// of the flat contrast.
  double edge_factor = 3.0;
  /// Where texture has raised the flat contrast, areas with at least so many pixels and so
  /// different in hue stay apart nevertheless; a* and b* units.
  int hue_pixels = 30;
  double hue_difference = 14;
  /// Areas with fewer pixels than this are joined to the most similar neighbour.
  int crumb_pixels = 12;
  /// An area this large is ground (a sheet, a tabletop in view with its rim), unless it is clear of
  /// the image's border and has `large_alone` of its boundary with the ground around it: there is
  /// nothing on it then. So is one with this share of the image's border.
  double ground_area = 0.3;
  double ground_border = 0.1;
  double large_alone = 0.97;
  /// Minimum difference of an object from the ground around it; L*a*b* units.
  double ground_difference = 4.0;
  /// Two areas may be of one surface if their colours differ by at most this angle, where a
  /// difference in saturation (white light mirrored on the same paint) counts `saturation_weight`.
  double surface_angle = 9.0;
  double saturation_weight = 0.5;
  /// Colours within the first angle of the ground's are shades of it, beyond the second they are
  /// not; a shade and a colour are never the same surface.
  double shade_angle = 12.0;
  double colour_angle = 14.0;
  /// Joined areas may leave this share of their own size of ground within their convex hull.
  double concavity = 0.06;
  /// Two coloured areas that make up a convex whole but for this share are one object even if their
  /// colours differ, when the boundary between them has at most `inner_contrast` times the contrast
  /// of the outline.
  double completion = 0.04;
  double inner_contrast = 0.7;
  /// Further costs of joining two areas, as degrees of colour difference: per unit of contrast
  /// between them, and per hundredth of the joint hull that belongs to others.
  double contrast_weight = 0.3;
  double hull_weight = 0.2;
  /// A darker shade of the ground beside something else is its shadow if it is smaller than this
  /// share of it, ends lower than this share of the way down it (things stand on their shadows,
  /// what is behind them is higher up), is brighter than this share of the ground (on a gamma
  /// encoded scale), less compact than this (1: a disc), and softer against the ground than against
  /// the thing.
  double shadow_area = 0.65;
  double shadow_foot = 0.3;
  double shadow_brightness = 0.3;
  double shadow_compactness = 0.65;
  /// Beside a thing that is itself a shade of the ground, a shadow must be softer by this factor.
  double shadow_softness = 0.55;
  /// A darker area that has the ground's own colour to within `shadow_angle` and is at most this
  /// bright is a shadow whatever its size, shape and edges, if areas whose colour is further from
  /// the ground's by `caster_angle` meet it along `shadow_contact` of its boundary, and the ground
  /// along `shadow_open`. On a ground nearer to grey than `grey_angle` it may as well be a grey
  /// thing: the limits are narrower, and its shades must be within `shadow_range` of each other.
  double grey_angle = 8.0;
  double shadow_angle = 4.0;
  double grey_shadow_angle = 1.5;
  double shadow_range = 0.055;
  double shadow_depth = 0.85;
  double caster_angle = 1.5;
  double shadow_contact = 0.15;
  double shadow_open = 0.4;
  double grey_shadow_open = 0.5;
  /// A piece of less than `inset_area` times its neighbour is part of it (a highlight, a mirrored
  /// thing) if at most this share of its boundary meets the ground and most of it the neighbour.
  double inset_area = 0.35;
  double inset_ground = 0.3;
  /// Whatever its outline, a piece smaller than this share of the image is part of the neighbour
  /// that most of its boundary is with. It is an object only if the ground has this share of its
  /// boundary, and if it is at least as compact as this (1: a disc).
  double piece_area = 0.001;
  double alone = 0.8;
  double piece_compactness = 0.45;
  /// Objects have at least this many pixels in the working image, and at least and at most these
  /// shares of the image; those that its border cuts off at most `max_cut_area`.
  int min_pixels = 60;
  double min_area = 0;
  double max_area = 0.85;
  double max_cut_area = 0.4;
  /// Objects with a larger share of their outline on the border of the image are dropped: what is
  /// cut off is not seen well enough. 1 keeps them all.
  double max_border = 0.2;
  /// How far the colours of an area without edges may spread (standard deviation; L*a*b* units) if
  /// it is to be one surface.
  double ground_spread = 20.0;
  /// Options for dividing things of one colour that touch each other.
  NeckOptions neck;
  /// Options used instead where no ground is found because texture hides the edges.
  CloseUpOptions close_up;
};

} // namespace castor::vision
