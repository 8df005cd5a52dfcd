#pragma once

#include "castor/planning/manipulation/arm_model.hpp"
#include "castor/planning/manipulation/scene.hpp"

#include <numbers>
#include <vector>

/// Ways to grasp a thing by its shape alone.
namespace castor::manipulation {

/// From straight down to the side, in so many steps.
inline std::vector<double> tilts_from_above(int steps) {
  std::vector<double> result;
  for (int i = 0; i <= steps; ++i)
    result.push_back(std::numbers::pi * (1 - 0.5 * i / steps));
  return result;
}

struct GraspOptions {
  /// Angles of the tool's z axis from straight up: pi is a grasp from above, pi / 2 one from the
  /// side.
  std::vector<double> tilts = tilts_from_above(12);
  /// How many ways to turn the fingers around what is round.
  int turns = 6;
  /// How many directions to come from, for arms that can choose it.
  int azimuths = 8;
  /// Metres that the open fingers have to spare on both sides together.
  double spare = 0.012;
  /// Metres between palm and thing, and between fingers and what it stands on.
  double gap = 0.007;
  /// Metres from where the tool begins to approach, at least.
  double approach = 0.05;
  /// Shares of clearance, of the distance of joints from their limits, and of steepness in the
  /// score.
  double clearance_share = 0.5;
  double limits_share = 0.3;
  double steepness_share = 0.2;
  /// Clearance that is as good as any, metres.
  double enough_clearance = 0.1;
};

/// Where to close the fingers.
struct GraspCandidate {
  Pose tool;
  double tilt = 0;
  /// Distance of the surfaces that the fingers close on, metres.
  double width = 0;
};

/// Grasps of a thing that stands on something, in the arm's frame: fingers close on parallel
/// surfaces of boxes and across what is round, around the middle or as deep as fingers are long.
/// Empty without a gripper, or if nothing is narrow enough for it.
/// @param follows_turret the arm comes from its own direction only, as those with
/// ClosedFormKinematics do
std::vector<GraspCandidate> grasp_candidates(const ArmModel& arm, const NamedSolid& thing,
                                             bool follows_turret, const GraspOptions& options = {});

/// Whether fingers that close on a thing touch it where it is widest, so that it does not slip out:
/// what is round slips out if they press on it above or below its middle, or beside. What has sides
/// may be touched anywhere, and so may the ends of a cylinder.
/// @param rim how far from the edges of the fingers they have to touch it, metres
bool is_between_pads(const Gripper& gripper, const NamedSolid& thing, const Pose& tool, double rim);

/// How far the tool has to go back along its own z axis until its fingers are no longer beside the
/// thing that they are around, at least `options.approach`; metres.
double way_out(const ArmModel& arm, const NamedSolid& thing, const Pose& tool,
               const GraspOptions& options);

/// Half of the thing's extent along a direction of length 1, metres.
double half_extent(const NamedSolid& thing, const Point3& direction);

/// The least distance between surfaces that fingers could close on, metres.
double least_width(const Solid& solid);

} // namespace castor::manipulation
