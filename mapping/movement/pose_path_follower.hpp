#pragma once

#include "castor/mapping/movement/pose_path.hpp"

#include <cstddef>
#include <vector>

namespace castor::mapping {

struct PoseFollowOptions {
  /// m/s, rad/s.
  double speed = 0.5;
  double max_turn = 1.2;
  /// Slower to brake so hard before it changes its direction, m/s^2.
  double braking = 0.4;
  /// Of the smallest circle that it drives, metres; 0: it turns on the spot.
  double turning_radius = 0;
};

/// Follows a path whose headings matter: it steers back to the place of the path that is nearest,
/// and to the heading there (Y. Kanayama et al., "A stable tracking control method for an
/// autonomous mobile robot", ICRA 1990). Motions that change the direction end where they should
/// before the next one begins.
class PosePathFollower {
public:
  /// \pre the path is not empty.
  PosePathFollower(PosePath path, const PoseFollowOptions& options);

  /// The velocity to have at that pose; zero after arrival.
  Twist2 velocity_at(const Pose2& robot);

  bool has_arrived() const { return motion_ == path_.motions.size(); }
  /// Whether it is on a motion that is no turn on the spot.
  bool is_driving() const { return !has_arrived() && path_.motions[motion_].forward != 0; }
  /// How far along the path it is, and the path's length; metres, turns do not count.
  double done() const { return done_; }
  double length() const { return length_; }
  /// Where it should be now.
  Pose2 reference() const;

  /// Where it should be from now on: what is left of the path, up to `way` metres of its outermost
  /// points.
  /// @param radius of those, metres
  /// @param step between two of them
  std::vector<Pose2> ahead(double way, double radius, double step) const;

  /// The end of the path.
  const Pose2& end() const { return begins_.back(); }
  const PosePath& path() const { return path_; }

private:
  void advance(const Pose2& robot);
  Twist2 turn(const Pose2& robot) const;
  Twist2 drive(const Pose2& robot) const;
  /// Way left until it stands or changes its direction.
  double way_to_stop() const;

  PosePath path_;
  PoseFollowOptions options_;
  std::vector<Pose2> begins_;
  std::size_t motion_ = 0;
  /// Share of the motion that is done.
  double share_ = 0;
  double done_ = 0;
  double length_ = 0;
};

} // namespace castor::mapping
