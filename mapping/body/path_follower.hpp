#pragma once

#include "castor/base/diagnostic.hpp"
#include "castor/mapping/planar/poses.hpp"

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace castor::mapping {

/// Waypoints that a robot is to drive along.
using Path = std::vector<Point2>;

struct PathText {
  Path path;
  std::vector<Diagnostic> problems;
};

/// Parses a path: two numbers for each waypoint, each on a line of its own or separated by commas;
/// metres, or with a unit. `#` begins a comment.
PathText parse_path(std::string_view text, const std::string& file_name);

struct FollowOptions {
  /// m/s and rad/s.
  double speed = 0.5;
  double max_turn = 1.2;
  /// How far ahead on the path the robot aims, metres.
  double look_ahead = 0.4;
  /// Distance from the last waypoint at which it has arrived, metres.
  double tolerance = 0.1;
};

/// Pure pursuit (R. C. Coulter, "Implementation of the pure pursuit path tracking algorithm",
/// 1992): the robot drives on the arc to a point of the path a little ahead of it. If that is far
/// aside, it turns on the spot first.
class PathFollower {
public:
  /// \pre the path has a waypoint.
  PathFollower(Path path, const FollowOptions& options);

  /// Goes on where another one was.
  void resume(double done) { done_ = std::clamp(done, 0.0, along_.back()); }

  /// The velocity to have at that pose. After arrival it is zero.
  /// @param shift of the path to the left, metres
  Twist2 velocity_at(const Pose2& pose, double shift = 0);

  /// How far to the left of the path the pose is, metres, where it is nearest.
  double aside(const Pose2& pose) const;

  /// The smallest shift of the path to the left, metres, with which no point is nearer than
  /// `clearance` to the next `way` metres of it; nothing if it would be more than `most` to either
  /// side.
  std::optional<double> free_shift(std::span<const Point2> points, double clearance, double way,
                                   double most) const;

  bool has_arrived() const { return has_arrived_; }
  /// How far along the path it is, and the path's length; metres.
  double done() const { return done_; }
  double length() const { return along_.back(); }

private:
  Point2 point_at(double way) const;
  Point2 shifted_point_at(double way, double shift) const;
  /// Where on the path, from where it was up to a little ahead, the pose is nearest.
  double progress_of(const Pose2& pose) const;

  Path path_;
  FollowOptions options_;
  /// Length of the path up to each waypoint.
  std::vector<double> along_;
  double done_ = 0;
  bool is_turning_ = false;
  bool has_arrived_ = false;
};

} // namespace castor::mapping
