#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "castor/perception/vision/types.hpp"

namespace castor::vision {

/// The box on the table of something that is seen within `contour`. Nothing, if its foot is not
/// seen on the table: at or above the horizon.
///
/// Without a third dimension, this is a guess: the lowest point of the outline touches the table; a
/// solid is as deep as it is wide, and stands upright. For a flat piece, the outline lies on the
/// table as a whole.
///
/// \param contour image coordinates.
std::optional<ObjectBox> extent_on_table(const Camera& camera, std::span<const Point2> contour,
                                         bool flat);

/// What is large.
struct SizeOptions {
  /// The longest side of a thing that may be called either; metres.
  double large_from = 0.10;
  /// How fast the confidence grows: at this factor from that length, the other name has a
  /// confidence of 0.1 left.
  double sure_factor = 1.3;
};

/// "large" and "small", the likelier first; confidences sum to 1. Nothing for a box without size.
std::vector<Hypothesis> judge_size(const ObjectBox& extent, const SizeOptions& options = {});

} // namespace castor::vision
