#pragma once

#include "castor/mapping/body/path_follower.hpp"
#include "castor/mapping/movement/path_planner.hpp"
#include "castor/mapping/movement/planning_map.hpp"
#include "castor/mapping/movement/types.hpp"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace castor::mapping {

struct PursuitOptions {
  PlanOptions plan;
  FollowOptions follow;
  /// How hard it counts on braking, m/s^2, and the time until a command has an effect, seconds.
  double braking = 0.4;
  double reaction = 0.2;
  /// Smallest distance of the robot's edge from what the laser sees, metres.
  double gap = 0.03;
  /// Where the map has less clearance, as in doors, it drives at most so fast; metres, m/s.
  double narrow_clearance = 0.45;
  double narrow_speed = 0.35;
  /// What the laser sees so far from all obstacles of the map is not on the map, metres.
  double unexpected_from = 0.15;
  /// Way ahead on the path that has to be free of that, metres.
  double look_out = 2.5;
  /// Times in microseconds. It plans at most so often.
  std::int64_t replan_period = 500'000;
  /// It gives up when the way was blocked for so long.
  std::int64_t patience = 30'000'000;
  /// It stands against something for so long before it backs off.
  std::int64_t stall_time = 3'000'000;
  /// How far it backs off, and how fast; metres, m/s.
  double back_off = 0.25;
  double back_off_speed = 0.12;
  /// It gives up after so many recoveries.
  int recoveries = 5;
};

/// Takes a robot to a place: plans, follows the path, plans anew around what the map does not have,
/// stops before what is in the way, backs off where it is stuck, and gives up with a reason.
///
/// Its only time is that of its arguments. Everything is in the map frame.
class GoalPursuit {
public:
  /// @param heading to face there, radians
  GoalPursuit(const Point2& goal, std::optional<double> heading, const PursuitOptions& options);

  struct Step {
    Twist2 velocity;
    /// `arrived` and `failed` are the ends.
    MovementStatus status = MovementStatus::moving;
    std::string waits_for;
    std::string reason;
  };

  /// @param time microseconds
  /// @param map with the same options for cells as those of the plan
  /// @param seen what the laser has seen lately
  Step step(std::int64_t time, const Pose2& robot, const PlanningMap& map,
            std::span<const Point2> seen);

  const Path& path() const { return path_; }
  double done() const { return follower_ ? follower_->done() : 0; }
  double length() const { return follower_ ? follower_->length() : 0; }
  int plans() const { return plans_; }
  int recoveries() const { return recoveries_; }
  /// Time that it stood since something was in its way, microseconds.
  std::int64_t waited() const { return waited_; }

private:
  std::vector<Point2> unexpected(const PlanningMap& map, std::span<const Point2> seen) const;
  /// Nothing of `points` is near the path ahead, nor does the map show anything there.
  bool is_path_free(const Pose2& robot, const PlanningMap& map,
                    std::span<const Point2> points) const;
  void plan(const Pose2& robot, const PlanningMap& map, std::span<const Point2> unexpected);
  Step stand(MovementStatus status, const std::string& waits_for);
  Step drive(const Pose2& robot, const PlanningMap& map, std::span<const Point2> seen);
  Step recover(const Pose2& robot, const PlanningMap& map, std::span<const Point2> seen);
  Step turn_at_goal(const Pose2& robot) const;
  Step fail(const std::string& reason) const;

  Point2 goal_;
  std::optional<double> heading_;
  PursuitOptions options_;
  Path path_;
  std::unique_ptr<PathFollower> follower_;
  std::string problem_;
  bool is_blocked_ = false;
  std::int64_t time_ = 0;
  std::optional<std::int64_t> step_time_;
  std::optional<std::int64_t> planned_;
  std::optional<std::int64_t> blocked_since_;
  std::optional<std::int64_t> stands_since_;
  std::optional<Pose2> backs_off_from_;
  std::int64_t waited_ = 0;
  int plans_ = 0;
  int recoveries_ = 0;
};

} // namespace castor::mapping
