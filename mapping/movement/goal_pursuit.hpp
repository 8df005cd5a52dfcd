#pragma once

#include "castor/mapping/body/path_follower.hpp"
#include "castor/mapping/body/stall_recovery.hpp"
#include "castor/mapping/movement/movers.hpp"
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
  /// Smallest distance of the robot's edge from what the laser sees, metres; and from what the map
  /// does not have, as people, whose legs are all that the laser sees of them.
  double gap = 0.03;
  double unexpected_gap = 0.1;
  /// Plans keep so much more from that than from what the map has, metres.
  double unexpected_margin = 0.07;
  /// Where the map has less clearance, as in doors, it drives at most so fast; metres, m/s.
  double narrow_clearance = 0.45;
  double narrow_speed = 0.35;
  /// So near to a gateway, it drives at most as fast as in narrow places, metres.
  double gateway_reach = 0.7;
  /// Those who walk. The radius of the robot is that of the plan.
  MoverOptions movers;
  /// What the laser sees so far from all obstacles of the map is not on the map, metres.
  double unexpected_from = 0.15;
  /// Way ahead on the path that has to be free of that, metres.
  double look_out = 2.5;
  /// Times in microseconds. It plans at most so often.
  std::int64_t replan_period = 500'000;
  /// It gives up when the way was blocked for so long.
  std::int64_t patience = 30'000'000;
  /// It waits so long for a free way where the way around is longer by more than that;
  /// microseconds, metres.
  std::int64_t detour_patience = 6'000'000;
  double detour = 3;
  StallOptions stall;
  /// It gives up after so many recoveries at one place: within that distance, metres.
  int recoveries = 5;
  double one_place = 1.5;
};

/// What is around a robot, in the map frame.
struct PursuitSurroundings {
  /// With the same options for cells as those of the plan.
  const PlanningMap& map;
  /// What the laser has seen lately.
  std::span<const Point2> seen;
  std::span<const Mover> movers = {};
  /// Middles of doors.
  std::span<const Point2> gateways = {};
};

/// Takes a robot to a place: plans, follows the path, waits for those who walk, plans anew around
/// what the map does not have, stops before what is in the way, goes back where it is stuck, and
/// gives up with a reason.
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
  Step step(std::int64_t time, const Pose2& robot, const PursuitSurroundings& around);

  /// Changes the goal. The next plan leads there; until then it follows the path that it has.
  void change_goal(const Point2& goal);

  /// To be called in place of `step` while the robot stands for another reason, so that it does not
  /// count as stalled.
  void hold(std::int64_t time, const Pose2& robot);

  const Path& path() const { return path_; }
  double done() const { return follower_ ? follower_->done() : 0; }
  double length() const { return follower_ ? follower_->length() : 0; }
  int plans() const { return plans_; }
  int recoveries() const { return recoveries_; }
  /// Time that it stood since something was in its way, microseconds.
  std::int64_t waited() const { return waited_; }

private:
  /// What the laser sees, the map does not have, and does not walk.
  std::vector<Point2> obstacles(const PursuitSurroundings& around) const;
  bool is_expected(const PlanningMap& map, const Point2& seen) const;
  /// Nothing of `points` is near the path ahead, nor does the map show anything there.
  bool is_path_free(const Pose2& robot, const PlanningMap& map,
                    std::span<const Point2> points) const;
  void plan(const Pose2& robot, const PlanningMap& map, std::span<const Point2> obstacles);
  PlannedPath plan_around(const Point2& start, const PlanningMap& map,
                          std::span<const Point2> obstacles) const;
  /// Whether the way around is so much longer that it waits for a free way first.
  bool is_worth_waiting(const PlannedPath& around) const;
  Step stand(MovementStatus status, const std::string& waits_for);
  Step drive(const Pose2& robot, const PursuitSurroundings& around);
  Step begin_recovery(const Pose2& robot, const PursuitSurroundings& around);
  Step recover(const Pose2& robot, const PursuitSurroundings& around);
  /// The velocity as far as the surroundings permit it, along the same arc.
  Twist2 limited(const Pose2& robot, const Twist2& wanted, const PursuitSurroundings& around) const;
  /// Greatest speed along the arc, so that the robot stops before what the laser sees.
  double speed_before(const Pose2& robot, const Twist2& wanted,
                      const PursuitSurroundings& around) const;
  Step turn_at_goal(const Pose2& robot) const;
  Step fail(const std::string& reason) const;

  Point2 goal_;
  std::optional<double> heading_;
  PursuitOptions options_;
  Path path_;
  std::unique_ptr<PathFollower> follower_;
  StallRecovery recovery_;
  std::string problem_;
  bool is_blocked_ = false;
  /// The path leads to a goal of before.
  bool is_goal_new_ = false;
  bool stands_ = false;
  std::int64_t time_ = 0;
  std::optional<std::int64_t> step_time_;
  std::optional<std::int64_t> planned_;
  std::optional<std::int64_t> blocked_since_;
  std::int64_t waited_ = 0;
  int plans_ = 0;
  int recoveries_ = 0;
  /// Where it began to recover last, and how often near there.
  Point2 stalled_at_;
  int recoveries_there_ = 0;
};

} // namespace castor::mapping
