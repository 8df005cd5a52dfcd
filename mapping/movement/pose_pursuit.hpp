#pragma once

#include "castor/mapping/movement/pose_path_follower.hpp"
#include "castor/mapping/movement/pose_planner.hpp"
#include "castor/mapping/movement/pursuit.hpp"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace castor::mapping {

struct PosePursuitOptions {
  Footprint footprint;
  PosePlanOptions plan;
  PoseFollowOptions follow;
  /// Times, gaps, speeds and those who walk; its plan and its recoveries are those of discs.
  PursuitOptions pursuit;
  /// Farther off its path than that, it plans anew; metres, radians.
  double most_aside = 0.15;
  double most_turned = 0.5;
  /// With less room on the map it drives as in narrow places, metres.
  double narrow_room = 0.2;
  /// So far from the goal it has arrived, metres, radians.
  double tolerance = 0.1;
  double facing = 0.15;
};

/// Takes a robot whose footprint is no disc to a place: plans poses, follows them, stops before
/// what its footprint would touch, plans anew around what the map does not have, and gives up with
/// a reason.
class PosePursuit final : public Pursuit {
public:
  /// @param heading to face there, radians
  PosePursuit(const Point2& goal, std::optional<double> heading, const PosePursuitOptions& options);

  Step step(std::int64_t time, const Pose2& robot, const PursuitSurroundings& around) override;

  /// Places along the planned way.
  const Path& path() const override { return path_; }
  double done() const override { return follower_ ? follower_->done() : 0; }
  double length() const override { return follower_ ? follower_->length() : 0; }
  int plans() const override { return plans_; }
  int recoveries() const override { return recoveries_; }
  std::int64_t waited() const override { return waited_; }

private:
  Step plan(const Pose2& robot, const PursuitSurroundings& around);
  /// Where it was stuck, the map may be wrong by a little, or the pose: all that the laser sees is
  /// an obstacle there. No path elsewhere, or if there is none.
  PlannedPosePath plan_around_all_seen(const Pose2& robot, const PursuitSurroundings& around);
  PlannedPosePath plan_with(const ClearanceMap& clearance, const Pose2& robot,
                            const PursuitSurroundings& around) const;
  /// Clearances with those obstacles, and `around` them, metres.
  ClearanceMap clearance_with(const PlanningMap& map, std::span<const Point2> obstacles,
                              double around) const;
  Step drive(const Pose2& robot, const PursuitSurroundings& around);
  /// What to do at the end of the path.
  Step finish(const Pose2& robot);
  /// Plans anew at the next step, unless it has done so too often at one place.
  Step begin_again(const Pose2& robot, const std::string& problem);
  bool is_at_goal(const Pose2& robot) const;
  bool is_off_path(const Pose2& robot) const;
  /// Whether the footprint fits along the path ahead.
  bool is_path_free(const PlanningMap& map, std::span<const Point2> obstacles) const;
  /// Share of a velocity that the surroundings permit.
  double permitted_share(const Pose2& robot, const Twist2& wanted,
                         const PursuitSurroundings& around) const;
  /// How far the outermost point of the footprint may move before it is too near to what is seen.
  double free_way(const Pose2& robot, double reach, const PursuitSurroundings& around) const;
  Step stand(MovementStatus status, const std::string& waits_for);

  Point2 goal_;
  std::optional<double> heading_;
  PosePursuitOptions options_;
  std::optional<PosePathFollower> follower_;
  Path path_;
  /// It was so near to obstacles when it planned that it keeps no more from those that the map does
  /// not have than from others.
  bool is_tight_ = false;
  StallRecovery stall_;
  bool stands_ = false;
  std::int64_t time_ = 0;
  std::optional<std::int64_t> step_time_;
  std::optional<std::int64_t> planned_;
  std::optional<std::int64_t> looked_;
  std::optional<std::int64_t> blocked_since_;
  std::int64_t waited_ = 0;
  int plans_ = 0;
  int recoveries_ = 0;
  Point2 stalled_at_;
  int recoveries_there_ = 0;
  /// Where it did not come further on its way.
  std::optional<Point2> stuck_at_;
};

} // namespace castor::mapping
