#pragma once

#include "castor/mapping/planar/types.hpp"

#include <cstddef>

namespace castor::mapping {

/// What stands alone and is no wider than somebody who walks.
struct NarrowOptions {
  /// m.
  double widest = 0.8;
  /// Neighbouring beams that end closer together are of one thing, m ...
  double same_thing = 0.15;
  /// ... or up to this share of their range, if that is more.
  double same_thing_share = 0.06;
  /// Things of fewer beams may be pieces of a wall at a small angle, whose beams end far apart:
  /// that what hides one side of them is narrow has to be known.
  std::size_t least_beams = 4;
};

/// The scan as if beams that ended at narrow things had not come back. A thing is narrow if the
/// beams on both sides go on behind it, or on one side, and something before it hides the other.
LaserScan without_narrow_things(LaserScan scan, const NarrowOptions& options = {});

} // namespace castor::mapping
