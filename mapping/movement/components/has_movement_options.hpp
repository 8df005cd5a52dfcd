#pragma once

#include "castor/actors/component/registry.hpp"
#include "castor/base/named_file.hpp"
#include "castor/mapping/body/components/drives_by_pose.hpp"
#include "castor/mapping/map_components/follows_grid.hpp"
#include "castor/mapping/maps/map_server.hpp"
#include "castor/mapping/movement/goal_pursuit.hpp"
#include "castor/mapping/movement/person_follower.hpp"
#include "castor/mapping/movement/pose_pursuit.hpp"

#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>

namespace castor::mapping {

/// By what a robot plans its ways: as a disc on the grid, or its footprint, if it turns on the
/// spot, or if it drives as a car does.
enum class PlannerKind { grid, footprint, reeds_shepp };
CASTOR_REFLECT_ENUM(PlannerKind, grid, footprint, reeds_shepp)

/// A component that moves the robot: its options, and what it pursues goals with by these.
class HasMovementOptions : public FollowsGrid<DrivesByPose> {
protected:
  HasMovementOptions() : FollowsGrid(PoseSource::localisation) {
    // nop
  }

  void configure() override {
    if (!map_file_->empty())
      map_ = read_map_server(file_named(map_file_, base_.get()));
    options_.plan.radius = radius_;
    options_.plan.margin = margin_;
    options_.plan.preferred_clearance = preferred_clearance_;
    options_.plan.cells.unknown_is_obstacle = !through_unknown_;
    options_.follow.speed = speed_;
    options_.follow.look_ahead = look_ahead_;
    options_.follow.tolerance = tolerance_;
    options_.braking = braking_;
    options_.gap = gap_;
    options_.unexpected_gap = unexpected_gap_;
    options_.narrow_speed = narrow_speed_;
    options_.movers.near = people_near_;
    options_.movers.near_speed = people_speed_;
    options_.patience = std::chrono::duration_cast<Timestamp>(patience_.get()).count();
    options_.recoveries = recoveries_;
    if (planner_ != PlannerKind::grid)
      configure_footprint();
  }

  const PursuitOptions& pursuit_options() const { return options_; }
  PlannerKind planner() const { return planner_; }
  /// Time between commands.
  std::chrono::milliseconds period() const { return period_.get(); }
  /// In place of the grid's tiles.
  const std::optional<CellMap>& given_map() const { return map_; }

  /// @param heading to face there, radians
  /// @param stops false: it only passes there
  std::unique_ptr<Pursuit> new_pursuit(const Point2& goal, std::optional<double> heading,
                                       bool stops) const {
    if (pose_options_) {
      auto options = *pose_options_;
      if (!stops)
        options.tolerance = passing_;
      return std::make_unique<PosePursuit>(goal, heading, options);
    }
    auto options = options_;
    if (!stops)
      options.follow.tolerance = passing_;
    return std::make_unique<GoalPursuit>(goal, heading, options);
  }

  /// Whether the footprint fits all along a turn on the spot. A disc always does.
  bool can_turn(const Pose2& robot, double angle, const PlanningMap& map,
                std::span<const Point2> seen) const {
    if (!pose_options_)
      return true;
    auto clearance = map.clearance();
    for (const auto& x : seen)
      clearance.add_obstacle(x, pose_options_->footprint.outer_radius());
    constexpr double step = 0.01; // metres
    return FootprintRoom(clearance, pose_options_->footprint, 0).is_free(robot, {0, angle}, step);
  }

  FollowPersonOptions follow_options(double distance) const {
    FollowPersonOptions result;
    result.distance = distance;
    result.nearest = std::min(result.nearest, distance);
    result.speed = follow_speed_;
    result.pursuit = options_;
    return result;
  }

private:
  void configure_footprint() {
    if (footprint_->empty())
      throw std::invalid_argument("--planner needs the robot's footprint: write its corners in "
                                  "order, --footprint \"X Y, X Y, ...\"");
    if (planner_ == PlannerKind::reeds_shepp && !(turning_radius_ > 0))
      throw std::invalid_argument("--planner reeds_shepp needs the radius of the smallest circle "
                                  "that the robot drives: --turning-radius METRES");
    pose_options_.emplace(
      PosePursuitOptions{parse_footprint(footprint_.get(), "--footprint"), {}, {}, options_});
    auto& x = *pose_options_;
    x.plan.margin = margin_;
    x.plan.cells = options_.plan.cells;
    x.follow.speed = speed_;
    x.follow.braking = braking_;
    x.tolerance = tolerance_;
    if (planner_ == PlannerKind::reeds_shepp) {
      x.plan.steering = PoseSteering::reeds_shepp;
      // With narrower circles than planned it steers back to its path.
      constexpr double wider = 1.2;
      x.plan.turning_radius = wider * turning_radius_;
      x.follow.turning_radius = turning_radius_;
    }
    // Ways along the graph, and whatever else is only estimated, are those of a disc.
    options_.plan.radius = x.footprint.inner_radius();
  }

  Option<std::string> map_file_{this, "map", "",
                                "a .yaml of map_server in place of the grid's tiles"};
  Option<std::string> base_{this, "base", "", "folder in which a relative file is looked for too"};
  Option<bool> through_unknown_{this, "through-unknown", false,
                                "whether it plans through cells that nobody has seen"};
  Option<PlannerKind> planner_{this, "planner", PlannerKind::grid,
                               "grid: the robot is a disc; footprint: it has corners, and turns on "
                               "the spot; reeds_shepp: it drives as a car does"};
  Option<std::string> footprint_{
    this, "footprint", "",
    "corners of its footprint in order, X Y, X Y, ..., metres; of --planner grid: --radius"};
  Option<double> turning_radius_{this, "turning-radius", 0,
                                 "of the smallest circle that a car drives, metres"};
  Option<double> radius_{this, "radius", 0.25, "of the robot's footprint, metres"};
  Option<double> margin_{this, "margin", 0.05, "to keep from obstacles of the map, metres"};
  Option<double> preferred_clearance_{this, "preferred-clearance", 0.6,
                                      "where there is less, a way counts as longer; metres"};
  Option<double> gap_{this, "gap", 0.03, "to keep from what the laser sees, metres"};
  Option<double> unexpected_gap_{this, "unexpected-gap", 0.1,
                                 "to keep from what the laser sees and the map does not have, "
                                 "metres"};
  Option<double> speed_{this, "speed", 0.5, "m/s"};
  Option<double> follow_speed_{this, "follow-speed", 1, "at most, behind a person; m/s"};
  Option<double> narrow_speed_{this, "narrow-speed", 0.35, "in doors and narrow places, m/s"};
  Option<double> people_near_{this, "people-near", 1,
                              "nearer than that, somebody who walks slows it down; metres"};
  Option<double> people_speed_{this, "people-speed", 0.3, "near people, m/s"};
  Option<double> braking_{this, "braking", 0.4, "how hard it counts on braking, m/s^2"};
  Option<double> look_ahead_{this, "look-ahead", 0.3, "how far ahead on the path it aims, metres"};
  Option<double> tolerance_{this, "tolerance", 0.1,
                            "distance from the goal at which it has arrived, metres"};
  Option<double> passing_{this, "passing", 0.4,
                          "so near, it has passed a place on its route, metres"};
  Option<std::chrono::milliseconds> patience_{this, "patience", std::chrono::seconds{30},
                                              "it gives up when every way was blocked for so long"};
  Option<int> recoveries_{this, "recoveries", 5, "it gives up after so many at one place"};
  Option<std::chrono::milliseconds> period_{this, "period", std::chrono::milliseconds{50},
                                            "time between commands"};

  PursuitOptions options_;
  /// Of robots that are no discs.
  std::optional<PosePursuitOptions> pose_options_;
  std::optional<CellMap> map_;
};

} // namespace castor::mapping
