#include "castor/benchmarks/exploration/exact_exploration.hpp"

#include "castor/mapping/building/solid_obstacles.hpp"
#include "castor/mapping/building/solids.hpp"
#include "castor/mapping/grid/occupancy_grid.hpp"
#include "castor/mapping/planar/poses.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <utility>

namespace castor::mapping {

namespace {

/// Height of the simulated laser, metres, and its range.
constexpr double laser_height = 0.3;
constexpr double laser_range = 12;

class ExactRobot {
public:
  ExactRobot(const Building& building, const ExactExplorationOptions& options)
    : options_(options),
      obstacles_(between_heights(solids_of(building), laser_height - 0.01, laser_height + 0.01)),
      pose_(building.start), planner_(options.exploration) {
    scan();
  }

  ExactExploration explore() {
    std::optional<Frontier> goal;
    while (result_.driven < options_.longest) {
      look();
      if (!goal || !planner_.is_open(*goal)) {
        goal = planner_.choose();
        if (!goal) {
          result_.finished = true;
          break;
        }
        ++result_.goals;
      }
      const auto way = plan_path(map_, ClearanceMap(map_, options_.plan.cells), {pose_.x, pose_.y},
                                 {goal->view.x, goal->view.y}, options_.plan);
      if (way.points.empty()) {
        planner_.failed(*goal, way.reason);
        goal.reset();
        continue;
      }
      if (!drive(way.points, options_.look_period))
        continue;
      turn_to(goal->view.heading);
      look();
      planner_.arrived(*goal);
      goal.reset();
    }
    result_.map = std::move(map_);
    result_.left = planner_.report(std::nullopt);
    return result_;
  }

private:
  void look() {
    map_ = cell_map(grid_);
    planner_.look(map_, pose_);
  }

  /// Returns whether it has come to the end of the way.
  bool drive(const std::vector<Point2>& way, double most) {
    for (std::size_t i = 1; i < way.size(); ++i) {
      double left = distance(Point2{pose_.x, pose_.y}, way[i]);
      if (left < 1e-6)
        continue;
      turn_to(std::atan2(way[i].y - pose_.y, way[i].x - pose_.x));
      while (left > 0) {
        if (most <= 0)
          return false;
        const double step = std::min({left, most, options_.scan_distance});
        pose_ = moved(pose_, {1, 0}, step);
        left -= step;
        most -= step;
        result_.driven += step;
        result_.time += step / options_.speed;
        scan_if_moved();
      }
    }
    return true;
  }

  void turn_to(double heading) {
    for (double left = normalised(heading - pose_.heading); left != 0;) {
      const double step = std::clamp(left, -options_.scan_turn, options_.scan_turn);
      pose_.heading = normalised(pose_.heading + step);
      left -= step;
      result_.time += std::abs(step) / options_.turn;
      scan_if_moved();
    }
  }

  void scan_if_moved() {
    constexpr double rounding = 1e-9;
    const auto& last = result_.path.back();
    if (distance(last, pose_) >= options_.scan_distance - rounding ||
        std::abs(normalised(pose_.heading - last.heading)) >= options_.scan_turn - rounding)
      scan();
  }

  /// As the simulated laser does: 180 degrees ahead, a beam each degree.
  void scan() {
    LaserScan scan;
    constexpr int beams = 181;
    scan.mount = {0.1, 0, 0};
    scan.first_angle = -std::numbers::pi / 2;
    scan.angle_step = std::numbers::pi / (beams - 1);
    scan.max_range = laser_range;
    const auto from = compose(pose_, scan.mount);
    for (int i = 0; i < beams; ++i)
      scan.ranges.push_back(static_cast<float>(
        obstacles_
          .cast({from.x, from.y}, from.heading + scan.first_angle + i * scan.angle_step,
                laser_range)
          .value_or(0)));
    grid_.insert(scan, pose_);
    result_.path.push_back(pose_);
  }

  const ExactExplorationOptions& options_;
  SolidObstacles obstacles_;
  Pose2 pose_;
  ExplorationPlanner planner_;
  OccupancyGrid grid_;
  CellMap map_;
  ExactExploration result_;
};

} // namespace

ExactExploration explore_exactly(const Building& building, const ExactExplorationOptions& options) {
  return ExactRobot(building, options).explore();
}

} // namespace castor::mapping
