#pragma once

#include "castor/mapping/body/path_follower.hpp"
#include "castor/mapping/movement/movers.hpp"

#include <cstdint>
#include <functional>
#include <optional>
#include <span>

namespace castor::mapping {

struct PassingOptions {
  /// Sideways from the path, at most and between two choices; metres.
  double most_shift = 0.8;
  double shift_step = 0.1;
  /// How much nearer to its shift the robot aims at a time, metres: the less, the earlier and the
  /// more gently it evades.
  double aim = 0.3;
  /// How far it looks ahead so that it evades in good time, seconds; where that shows no way, as
  /// far as `MoverOptions` say.
  double horizon = 4;
  /// Slowest speed at which it passes somebody, m/s.
  double slowest = 0.15;
  /// Of the bodies of those who stand, of whom the laser sees no more than legs, metres.
  double standing_radius = 0.2;
  /// It makes room for those who do not pass after so long, microseconds.
  std::int64_t patience = 6'000'000;
};

/// How a robot goes on among those who walk: beside its path, to the left, and at most so fast;
/// metres, m/s.
struct Passing {
  double shift = 0;
  double speed = 0;
};

/// Velocity towards a path that is shifted, aside no more than by `options.aim` at a time.
Twist2 velocity_aside(PathFollower& follower, const Pose2& robot, double shift,
                      const PassingOptions& options);

/// Chooses shift and speed by following the path with each of them up to a horizon: that which
/// comes furthest, where nobody who goes on as he walks comes nearer than the gap of that speed
/// (`gap_at`), unless he would if the robot stood, and not sooner because it drives.
/// @param before the shift of now, which it rather keeps
/// @param fastest m/s
/// @param is_free whether the robot can be at a place beside the path
/// @return nothing if the robot has to stand
std::optional<Passing> choose_passing(const PathFollower& follower, const Pose2& robot,
                                      double before, double fastest, std::span<const Mover> movers,
                                      const MoverOptions& mover_options,
                                      const std::function<bool(const Point2&)>& is_free,
                                      const PassingOptions& options = {});

} // namespace castor::mapping
