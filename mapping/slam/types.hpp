#pragma once

#include "castor/mapping/planar/types.hpp"
#include "castor/wm/values/reflect.hpp"

#include <cstdint>
#include <string>
#include <vector>

/// Entry types of simultaneous localisation and mapping, its only interface to other
/// subarchitectures. Metres, radians, microseconds.
namespace castor::mapping {

/// Covariance of a pose, symmetric; m2, m rad and rad2.
struct PoseCovariance {
  double xx = 0;
  double xy = 0;
  double x_heading = 0;
  double yy = 0;
  double y_heading = 0;
  double heading = 0;

  friend bool operator==(const PoseCovariance&, const PoseCovariance&) = default;
};

/// Entry: a place on the path of the robot with what the laser saw there. Added by the front end,
/// never changed; its corrected pose is in GraphPoses.
struct Keyframe {
  /// From 0, without gaps.
  std::int64_t number = 0;
  /// Of the scan, microseconds since the system began.
  std::int64_t time = 0;
  /// Pose of the robot by its wheels, in the odometry frame.
  Pose2 odometry;
  /// Pose of the robot by its scans, in the front end's own frame: without jumps, but it drifts.
  Pose2 local_pose;
  LaserScan scan;

  friend bool operator==(const Keyframe&, const Keyframe&) = default;
};

enum class ConstraintKind {
  /// From one keyframe to the next, by their scans.
  motion,
  /// From one keyframe to the next by the wheels alone: their scans were of no use.
  wheels,
  /// Between keyframes that saw the same place at different times.
  loop
};

/// Entry: how one keyframe lies as seen from another, as measured. An edge of the pose graph.
struct Constraint {
  /// Numbers of keyframes.
  std::int64_t from = 0;
  std::int64_t to = 0;
  ConstraintKind kind = ConstraintKind::motion;
  /// Pose of `to` on `from`.
  Pose2 pose;
  /// Of that pose.
  PoseCovariance covariance;

  friend bool operator==(const Constraint&, const Constraint&) = default;
};

/// Entry: poses of the keyframes in the map frame by all constraints together. There is one, which
/// is overwritten.
struct GraphPoses {
  /// Counts the versions; a higher one knows more.
  std::int64_t version = 0;
  /// Time of the newest keyframe in it.
  std::int64_t time = 0;
  /// By number of keyframe.
  std::vector<Pose2> poses;
  /// Pose of the front end's own frame in the map frame, by the newest of these keyframes: those
  /// that are not in it yet are at compose(local_frame, keyframe.local_pose).
  Pose2 local_frame;
  /// How many loop constraints it has, and how many of them are at odds with the others.
  std::int64_t loops = 0;
  std::int64_t doubted_loops = 0;

  friend bool operator==(const GraphPoses&, const GraphPoses&) = default;
};

enum class LocalisationState {
  /// Nothing is known yet.
  starting,
  /// The newest scan fits to the map.
  tracking,
  /// The newest scan did not fit; the pose is that of the wheels since the last that did.
  dead_reckoning,
  /// Not known where.
  lost
};

/// Entry: where the robot is. There is one, which is overwritten.
struct RobotPose {
  /// Of the scan or odometry that it is by, microseconds since the system began.
  std::int64_t time = 0;
  /// Name of the frame, "map" as a rule.
  std::string frame;
  Pose2 pose;
  /// Against the part of the map around it.
  PoseCovariance covariance;
  LocalisationState state = LocalisationState::starting;
  /// The reason for the state, for people; may be empty.
  std::string reason;

  friend bool operator==(const RobotPose&, const RobotPose&) = default;
};

CASTOR_REFLECT(PoseCovariance, xx, xy, x_heading, yy, y_heading, heading)
CASTOR_REFLECT(Keyframe, number, time, odometry, local_pose, scan)
CASTOR_REFLECT_ENUM(ConstraintKind, motion, wheels, loop)
CASTOR_REFLECT(Constraint, from, to, kind, pose, covariance)
CASTOR_REFLECT(GraphPoses, version, time, poses, local_frame, loops, doubted_loops)
CASTOR_REFLECT_ENUM(LocalisationState, starting, tracking, dead_reckoning, lost)
CASTOR_REFLECT(RobotPose, time, frame, pose, covariance, state, reason)

} // namespace castor::mapping
