#pragma once

#include "castor/mapping/movement/passing.hpp"
#include "castor/mapping/movement/pursuit.hpp"

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace castor::mapping {

/// Takes a robot to a place: plans, follows the path, waits for those who walk or passes them,
/// plans anew around what the map does not have, stops before what is in the way, goes back where
/// it is stuck, and gives up with a reason. For robots that are discs.
class GoalPursuit final : public Pursuit {
public:
  /// @param heading to face there, radians
  GoalPursuit(const Point2& goal, std::optional<double> heading, const PursuitOptions& options);

  Step step(std::int64_t time, const Pose2& robot, const PursuitSurroundings& around) override;

  /// Changes the goal. The next plan leads there; until then it follows the path that it has.
  void change_goal(const Point2& goal);

  /// Drives at most so fast from now on, m/s.
  void limit_speed(double speed) { most_speed_ = speed; }

  /// To be called in place of `step` while the robot stands for another reason, so that it does not
  /// count as stalled.
  void hold(std::int64_t time, const Pose2& robot);

  const Path& path() const override { return path_; }
  double done() const override { return follower_ ? follower_->done() : 0; }
  double length() const override { return follower_ ? follower_->length() : 0; }
  int plans() const override { return plans_; }
  int recoveries() const override { return recoveries_; }
  std::int64_t waited() const override { return waited_; }

private:
  /// What the path asks for, and what the surroundings permit.
  struct Motion {
    Twist2 wanted;
    Twist2 velocity;
    bool waits_for_mover = false;
  };

  /// Nothing of `points` is near the path ahead, nor does the map show anything there.
  bool is_path_free(const Pose2& robot, const PlanningMap& map,
                    std::span<const Point2> points) const;
  void plan(const Pose2& robot, const PlanningMap& map, std::span<const Point2> obstacles);
  PlannedPath plan_around(const Point2& start, const PlanningMap& map,
                          std::span<const Point2> obstacles) const;
  /// Whether it has come further on its way lately.
  bool comes_nearer();
  /// Whether the way around is so much longer that it waits for a free way first.
  bool is_worth_waiting(const PlannedPath& around, const Point2& start,
                        const PlanningMap& map) const;
  Step stand(MovementStatus status, const std::string& waits_for);
  Step drive(const Pose2& robot, const PursuitSurroundings& around,
             std::span<const Point2> in_the_way);
  Step begin_recovery(const Pose2& robot, const PursuitSurroundings& around);
  /// Goes back a little, and plans anew.
  Step go_back(const Pose2& robot, const PursuitSurroundings& around);
  Step recover(const Pose2& robot, const PursuitSurroundings& around);
  /// The velocity as far as the surroundings permit it, along the same arc.
  Twist2 limited(const Pose2& robot, const Twist2& wanted, const PursuitSurroundings& around) const;
  /// Along the path, standing before those who walk.
  Motion along_path(const Pose2& robot, const PursuitSurroundings& around);
  /// Beside the path, past those who walk.
  Motion beside_path(const Pose2& robot, const PursuitSurroundings& around,
                     std::span<const Point2> in_the_way);
  /// How it passes those who walk; nothing if it has to stand.
  std::optional<Passing> passing(const Pose2& robot, const PursuitSurroundings& around,
                                 std::span<const Point2> in_the_way) const;
  /// Greatest speed where the robot is, m/s.
  double speed_here(const Pose2& robot, const PursuitSurroundings& around) const;
  /// Greatest speed along the arc, so that the robot stops before what the laser sees.
  double speed_before(const Pose2& robot, const Twist2& wanted,
                      const PursuitSurroundings& around) const;
  Step turn_at_goal(const Pose2& robot) const;
  Step fail(const std::string& reason) const;

  Point2 goal_;
  std::optional<double> heading_;
  PursuitOptions options_;
  double most_speed_ = std::numeric_limits<double>::infinity();
  Path path_;
  std::unique_ptr<PathFollower> follower_;
  /// To the left of the path, as it passes somebody; metres.
  double shift_ = 0;
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
  /// For somebody to pass.
  std::optional<std::int64_t> waits_since_;
  std::int64_t waited_ = 0;
  /// Least way that was left so far, metres, and since when.
  std::optional<double> least_left_;
  std::int64_t nearer_at_ = 0;
  int plans_ = 0;
  int recoveries_ = 0;
  /// Where it began to recover last, and how often near there.
  Point2 stalled_at_;
  int recoveries_there_ = 0;
};

} // namespace castor::mapping
