#pragma once

#include "castor/planning/manipulation/blended_path.hpp"
#include "castor/planning/manipulation/collision_checker.hpp"

#include <vector>

namespace castor::manipulation {

/// Where the joints are, and how they move, at one time: radians, rad/s, rad/s^2; of slides metres.
struct JointState {
  Configuration positions;
  Configuration speeds;
  Configuration accelerations;
};

/// A motion along a path in the shortest time that the speeds and accelerations of the joints
/// permit, from rest to rest.
class Trajectory {
public:
  struct Interval {
    /// On the path; the speed along it is sqrt(x) at both ends, and changes evenly between.
    double begin = 0;
    double end = 0;
    double x_begin = 0;
    double x_end = 0;
    /// Seconds after the trajectory's beginning.
    double time = 0;
    double duration = 0;
    /// Index of the path's piece.
    std::size_t piece = 0;
  };

  Trajectory(BlendedPath path, std::vector<Interval> intervals);

  /// Seconds.
  double duration() const;

  /// At `time` seconds after the beginning; before and after it, the arm rests.
  JointState at(double time) const;

  const BlendedPath& path() const { return path_; }

private:
  BlendedPath path_;
  std::vector<Interval> intervals_;
};

struct TimingOptions {
  /// Distance of points on the path, radians, for which speeds are calculated.
  double grid = 0.01;
  /// Share of the joints' speeds and accelerations that is used, above 0 to 1.
  double speed_share = 1;
  double acceleration_share = 1;
  /// How far before a corner it begins to be rounded at most, radians.
  double blend_radius = 0.2;
};

/// The time-optimal speeds along a path, by reachability analysis (Pham and Pham, "A new approach
/// to time-optimal path parameterization based on reachability analysis", 2018): limits are kept at
/// every time. At corners that are not rounded, the arm stops.
Trajectory time_parameterise(const ArmModel& arm, const BlendedPath& path,
                             const TimingOptions& options = {});

/// Trajectory along the waypoints, with corners that are rounded as far as it has no contact.
/// @param waypoints at least one; those of a motion without contact
Trajectory time_parameterise(const ArmModel& arm, CollisionChecker& checker,
                             const std::vector<Configuration>& waypoints,
                             const TimingOptions& options = {});

} // namespace castor::manipulation
