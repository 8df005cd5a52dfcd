#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "castor/perception/vision/types.hpp"

namespace castor::vision {

/// The box on the table of an object with the outline `contour`, in the frame of the camera's pose,
/// whose plane z = 0 is the table. Nothing if its foot is not on the
/// table: at or above the horizon.
///
/// As an image has no depth, these are assumptions: a solid is as deep as it is wide, and stands
/// upright; of all but balls, the lowest point of the outline touches the table. The highest is the
/// far side of the top of cubes and cylinders, the near side if that is above the camera, and half
/// way to the far side for other names. For a flat piece, the whole outline is on the table.
///
/// \param contour image coordinates.
/// \param shape as vision names it; any other name if it is not known.
std::optional<AlignedBox> extent_on_table(const Camera& camera, std::span<const Point2> contour,
                                          const std::string& shape = {});

/// Options for "large" and "small".
struct SizeOptions {
  /// Longest side at which both names are equally likely; metres.
  double large_from = 0.10;
  /// Slope of the confidence: at this factor from that length, the other name has a confidence of
  /// 0.1.
  double sure_factor = 1.3;
  /// How likely it is that an assumed camera measures lengths well enough; if it does not, both
  /// names are equally likely.
  double trust_in_assumed = 0.5;
};

/// "large" and "small", the likelier first; confidences sum to 1. Nothing for a box without size.
///
/// \param is_assumed whether the extent was measured with a camera that is not calibrated.
std::vector<Hypothesis> judge_size(const AlignedBox& extent, bool is_assumed,
                                   const SizeOptions& options = {});

} // namespace castor::vision
