#pragma once

#include "castor/perception/spatial/types.hpp"
#include "castor/planning/manipulation/grasp_candidates.hpp"
#include "castor/planning/manipulation/inverse_kinematics.hpp"

#include <cstdint>
#include <vector>

namespace castor::manipulation {

struct ReachMapOptions {
  /// Where things may be on the table, around its middle; metres.
  double width = 0.60;
  double depth = 0.52;
  double step = 0.02;
  /// Of things.
  std::vector<double> heights{0.02, 0.04, 0.06, 0.08, 0.10};
  /// Diameter of things.
  double thickness = 0.05;
  /// How far above its grasp the tool has to get to with the thing.
  double lift = 0.036;
  GraspOptions grasps;
};

/// Where an arm grasps things that stand on a table which is otherwise empty, and so can put them
/// down, too. Ways to hold them are the tilts of `options.grasps`.
/// @param at pose of the arm in the table's frame, on its surface
spatial::ReachableTable reach_map(const ArmModel& arm, const InverseKinematics& inverse,
                                  const Pose& at, const ReachMapOptions& options = {});

/// Whether it grasps things of some height at the point of the grid that is nearest.
bool is_reached(const spatial::ReachableTable& reach, const spatial::GroundPoint& at);

/// The way, a bit as those of reach_map(), that is nearest to the one in which a thing is held; all
/// of them if it is held from below.
/// @param held its pose in the tool's frame; z is its upper side
std::uint32_t ways_held(const Pose& held, const GraspOptions& options);

} // namespace castor::manipulation
