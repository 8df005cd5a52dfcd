#pragma once

#include "castor/mapping/movement/footprint_room.hpp"
#include "castor/mapping/movement/pose_plan_options.hpp"

#include <cstdint>
#include <vector>

namespace castor::mapping {

/// How far an outline moves between two looks at a way that is found, metres.
constexpr double fine_step = 0.005;

/// One search of several.
struct PoseSearch {
  std::uint32_t seed = 1;
  /// Seconds, and steps: what is over first.
  double time_limit = 1;
  unsigned steps = 1000;
  /// Of one motion, metres.
  double range = 1;
};

/// A way and what it costs; empty if none was found.
struct FoundPoses {
  PosePath path;
  double cost = 0;
};

/// Searches by OMPL for plan_poses; OMPL's headers are included by its source file only.
/// @param guide way of a disc, near which it samples more
FoundPoses search_poses(const CellMap& map, const FootprintRoom& room, const Pose2& start,
                        const std::vector<Pose2>& goals, const std::vector<Point2>& guide,
                        const PosePlanOptions& options, const PoseSearch& attempt);

} // namespace castor::mapping
