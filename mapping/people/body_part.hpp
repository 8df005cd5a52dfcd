#pragma once

#include "castor/mapping/planar/poses.hpp"

namespace castor::mapping {

/// What a scan shows of a leg, of two legs side by side, or of a body.
struct BodyPart {
  /// Its middle.
  Point2 place;
  /// Metres across the beams.
  double width = 0;
  /// It is where it was free before.
  bool is_new = false;
  /// The beams on both sides pass it, so that it is no piece of something larger.
  bool stands_out = false;
  /// Something has been there for about a second.
  bool is_settled = false;
};

} // namespace castor::mapping
