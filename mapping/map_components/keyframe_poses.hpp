#pragma once

#include "castor/mapping/exports/map_contents.hpp"
#include "castor/mapping/slam/types.hpp"

#include <optional>
#include <vector>

namespace castor::mapping {

/// Corrected pose of the robot at a keyframe: that of the graph, or for a keyframe that is not in
/// it yet, the front end's pose in the frame of the map. Without a graph, which is null then, the
/// front end's frame is the map's.
Pose2 pose_in_map(const Keyframe& keyframe, const GraphPoses* graph);

/// Inverse of a covariance, as an ExportedConstraint has it. A covariance that is not positive
/// definite is replaced by its diagonal, with variances of at least 1e-9.
std::array<double, 6> information_of(const PoseCovariance& covariance);

/// What there is to export, sorted by the numbers of keyframes. Constraints with a keyframe that is
/// missing are left out.
MapContents contents_of(std::vector<Keyframe> keyframes, const std::optional<GraphPoses>& graph,
                        const std::vector<Constraint>& constraints);

} // namespace castor::mapping
