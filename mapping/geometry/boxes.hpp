#pragma once

#include "castor/mapping/geometry/types.hpp"

#include <algorithm>
#include <cmath>

namespace castor::geometry {

/// Whether a thing that stood in the box `before` has moved over the ground by more than its own
/// width. What is jostled, or estimated a little otherwise, has not moved.
inline bool has_moved(const AlignedBox& before, const AlignedBox& now) {
  return before.frame != now.frame ||
         std::hypot(now.centroid.x - before.centroid.x, now.centroid.y - before.centroid.y) >
           std::min(before.size.x, now.size.x);
}

/// Whether a thing is taken for as high as in the box `now` since its shape was found out: it is
/// flat and was not, or the other way round, or its height differs by more than a twentieth.
inline bool is_refined(const AlignedBox& before, const AlignedBox& now) {
  constexpr double same_height = 0.05; // of the height
  return std::abs(now.size.z - before.size.z) > same_height * before.size.z;
}

} // namespace castor::geometry
