#pragma once

#include "castor/mapping/geometry/types.hpp"

#include <algorithm>
#include <cmath>

namespace castor::geometry {

/// Whether it is the box of something flat on the ground.
inline bool is_flat(const AlignedBox& x) { return x.size.z == 0; }

/// Whether a thing that stood in the box `before` has moved over the ground by more than its own
/// width, or is taken for flat and was not, or the other way round: its first estimate was another
/// one. What is jostled, or estimated a little otherwise, has not moved.
inline bool has_moved(const AlignedBox& before, const AlignedBox& now) {
  if (before.frame != now.frame || is_flat(before) != is_flat(now))
    return true;
  return std::hypot(now.centroid.x - before.centroid.x, now.centroid.y - before.centroid.y) >
         std::min(before.size.x, now.size.x);
}

} // namespace castor::geometry
