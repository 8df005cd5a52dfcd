#pragma once

#include "castor/mapping/body/path_follower.hpp"
#include "castor/mapping/body/stall_recovery.hpp"
#include "castor/mapping/movement/movers.hpp"
#include "castor/mapping/movement/passing.hpp"
#include "castor/mapping/movement/path_planner.hpp"
#include "castor/mapping/movement/planning_map.hpp"
#include "castor/mapping/movement/types.hpp"

#include <cstdint>
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
  /// How it passes those who walk; without, it stands before them.
  std::optional<PassingOptions> passing;
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
  /// It gives up when it has not come further on its way for so long, microseconds.
  std::int64_t longest = 300'000'000;
  StallOptions stall;
  /// It gives up after so many recoveries at one place: within that distance, metres.
  int recoveries = 5;
  double one_place = 1.5;
  /// How far ahead on the path it aims there afterwards, metres.
  double careful_look_ahead = 0.15;
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

/// What the laser sees and the map has, too.
bool is_expected(const PlanningMap& map, const Point2& seen, const PursuitOptions& options);

/// What the laser sees, the map does not have, and does not walk; and where the robot passes
/// people, the bodies of those who stand.
std::vector<Point2> unexpected_obstacles(const PursuitSurroundings& around,
                                         const PursuitOptions& options);

/// Greatest speed at a place: less in narrow ones and in doors, m/s.
/// @param is_narrow whether there is little room around the robot
double place_speed(const Point2& here, bool is_narrow, const PursuitSurroundings& around,
                   const PursuitOptions& options);

/// Takes a robot to a place. Its only time is that of its arguments. Everything is in the map
/// frame.
class Pursuit {
public:
  struct Step {
    Twist2 velocity;
    /// `arrived` and `failed` are the ends.
    MovementStatus status = MovementStatus::moving;
    std::string waits_for;
    std::string reason;
  };

  virtual ~Pursuit() = default;

  /// @param time microseconds
  virtual Step step(std::int64_t time, const Pose2& robot, const PursuitSurroundings& around) = 0;

  virtual const Path& path() const = 0;
  /// How far along the path it is, and the path's length; metres.
  virtual double done() const = 0;
  virtual double length() const = 0;
  /// Numbers so far.
  virtual int plans() const = 0;
  virtual int recoveries() const = 0;
  /// Time that it stood since something was in its way, microseconds.
  virtual std::int64_t waited() const = 0;
};

} // namespace castor::mapping
