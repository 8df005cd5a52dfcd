#pragma once

#include "castor/planning/manipulation/blocked_way.hpp"
#include "castor/planning/manipulation/grasp_candidates.hpp"
#include "castor/planning/manipulation/inverse_kinematics.hpp"

#include <string>
#include <variant>
#include <vector>

namespace castor::manipulation {

/// A grasp that the arm can carry out.
struct Grasp {
  GraspCandidate candidate;
  /// How far the gripper is open on the way, metres.
  double opening = 0;
  /// From where the tool begins to approach, to the grasp, on a straight line.
  std::vector<Configuration> approach;
  /// Distance from the nearest thing other than that which is grasped and what it stands on,
  /// metres.
  double clearance = 0;
  /// 0 to 1, the larger the better.
  double score = 0;
};

/// Either grasps, the best first and at least one, or why there is none.
using GraspResult = std::variant<std::vector<Grasp>, MotionFailure>;

/// Grasps of a thing of the scene, ranked by clearance, distance of joints from their limits, and
/// steepness. Contacts are looked for on the approach, but the way to its beginning is not planned.
/// @param near of several configurations of the arm, the nearest to this is preferred
/// \throws std::invalid_argument if there is no such thing in the scene.
GraspResult find_grasps(const ArmModel& arm, const InverseKinematics& inverse, const Scene& scene,
                        const std::string& thing, const Configuration& near,
                        const GraspOptions& options = {});

} // namespace castor::manipulation
