#pragma once

#include "castor/mapping/movement/footprint_room.hpp"
#include "castor/mapping/movement/pose_plan_options.hpp"

#include <optional>
#include <string>

namespace castor::mapping {

struct PlannedPosePath {
  PosePath path;
  /// Why there is none. If `is_proved`, not even a disc that fits into the footprint could go
  /// there, or the robot does not fit at the goal; else a way was not found in time.
  std::string reason;
  bool is_proved = false;
};

/// Plans the way of a footprint over a map, by OMPL's RRT-Connect (J. J. Kuffner and S. M. LaValle,
/// "RRT-Connect: an efficient approach to single-query path planning", ICRA 2000), which samples
/// more near the way of a disc that fits into the footprint. Only complete ways are taken, and
/// those only if they are free when looked at more closely than while they were sought.
/// @param clearance of `map`, with the same options
/// @param heading at the goal, radians; nothing: any
PlannedPosePath plan_poses(const CellMap& map, const ClearanceMap& clearance,
                           const Footprint& footprint, const Pose2& start, const Point2& goal,
                           std::optional<double> heading, const PosePlanOptions& options);

} // namespace castor::mapping
