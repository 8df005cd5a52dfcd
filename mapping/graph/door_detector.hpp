#pragma once

#include "castor/mapping/planar/poses.hpp"
#include "castor/mapping/planar/types.hpp"

#include <vector>

namespace castor::mapping {

/// Rules for what is taken for a door in a scan. Widths, posts, gap and clearance are those of
/// CAST's Explorer (CogX, component `SpatialControl` with its door detector).
struct DoorOptions {
  /// Distance between the posts, metres.
  double least_width = 0.6;
  double most_width = 1.05;
  /// A wall of at least this length is beside the opening, on both sides; metres.
  double post = 0.05;
  /// Neighbouring points of that wall are at most this far apart, and three beams; metres.
  double gap = 0.02;
  /// That wall is at most this far off the line through both posts, metres.
  double offset = 0.04;
  /// A beam through the opening goes on for at least this long, metres.
  double clearance = 1.5;
  /// Posts are looked for up to here, metres.
  double reach = 5;
  /// Largest angle between the way through and the line of sight, radians.
  double most_slant = 1.1;
};

/// An opening in a wall, as one scan shows it, in the frame of the robot.
struct Opening {
  /// As seen from the robot.
  Point2 right;
  Point2 left;

  double width() const { return distance(right, left); }
  /// The middle, facing away from the robot.
  Pose2 pose() const;
};

/// Finds doors that are open in a scan: two posts, the nearest points of a wall on both sides of a
/// gap, that beams pass between. Each post is the end of the wall's line: half a beam is added
/// where the wall ends between two beams.
/// @param ignored for each beam, whether it is left out, as one that hit somebody who moves; empty:
/// none
std::vector<Opening> find_openings(const LaserScan& scan, const std::vector<bool>& ignored = {},
                                   const DoorOptions& options = {});

} // namespace castor::mapping
