#pragma once

#include "castor/mapping/body/path_follower.hpp"

#include <cstdint>
#include <deque>
#include <optional>

namespace castor::mapping {

struct StallOptions {
  /// A robot that is to move and has not come further than this for so long is stalled: metres,
  /// radians, microseconds.
  double least_way = 0.05;
  double least_turn = 0.2;
  std::int64_t patience = 3'000'000;
  /// How far it goes back along its trail, and how fast; metres, m/s.
  double way_back = 0.5;
  double speed = 0.2;
  /// A recovery ends after that time, whether it has come so far or not, microseconds.
  std::int64_t longest = 12'000'000;
};

/// Notices that a robot does not come further, and leads it back along the way it came: it turns
/// and drives there, so that its laser sees where it goes. On the way a localisation that was wrong
/// gets new scans.
///
/// For robots that turn on the spot. Its only time is that of its arguments, microseconds.
class StallRecovery {
public:
  explicit StallRecovery(const StallOptions& options = {}) : options_(options) {}

  /// To be called at each step, with where the robot is and whether it is to move: true if it has
  /// stalled, by which that is told once. Remembers the trail.
  bool has_stalled(std::int64_t time, const Pose2& robot, bool is_to_move);

  /// Begins to go back. False if there is no trail yet.
  bool begin(std::int64_t time, const Pose2& robot);

  /// Whether it is going back.
  bool is_active() const { return follower_.has_value(); }

  /// Velocity on the way back; nothing at its end. Whether the way is free is left to the caller.
  std::optional<Twist2> velocity(std::int64_t time, const Pose2& robot);

private:
  StallOptions options_;
  /// Newest first.
  std::deque<Point2> trail_;
  /// Since when the robot is to move, and has not come further than from there.
  std::optional<std::int64_t> since_;
  Pose2 from_;
  std::optional<PathFollower> follower_;
  std::int64_t begun_ = 0;
};

} // namespace castor::mapping
