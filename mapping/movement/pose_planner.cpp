#include "castor/mapping/movement/pose_planner.hpp"

#include "castor/mapping/movement/path_planner.hpp"
#include "castor/mapping/movement/pose_search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <vector>

namespace castor::mapping {

namespace {

/// A search that has not found a way soon rarely does so later, and narrow places take shorter
/// motions than wide ones.
PoseSearch attempt(int number, double time_limit, const PosePlanOptions& options) {
  constexpr std::array<double, 3> ranges{2, 0.7, 0.3};
  constexpr std::size_t longest = 6;
  const auto i = static_cast<std::size_t>(number);
  PoseSearch result;
  result.seed = options.seed + static_cast<std::uint32_t>(number);
  result.time_limit = time_limit;
  result.steps = options.steps << std::min(i / ranges.size(), longest);
  result.range = ranges[i % ranges.size()];
  return result;
}

class PosePlanner {
public:
  PosePlanner(const CellMap& map, const ClearanceMap& clearance, const Footprint& footprint,
              const PosePlanOptions& options)
    : map_(map), clearance_(clearance), footprint_(footprint), options_(options) {}

  PlannedPosePath plan(const Pose2& start, const Point2& goal, std::optional<double> heading) {
    const double margin = margin_at(start);
    if (margin < 0)
      return {{},
              fmt::format("the robot's footprint touches an obstacle, or what is not explored yet, "
                          "at {:.2f} {:.2f}",
                          start.x, start.y),
              true};
    const auto guide = guide_to(start, goal, margin);
    if (guide.points.empty())
      return {{}, guide.reason, true};
    const FootprintRoom room(clearance_, footprint_, margin);
    const auto goals = goals_at(goal, heading, room);
    if (goals.empty())
      return {{},
              heading ? "the robot's footprint does not fit at the goal as it is to face there"
                      : "the robot's footprint does not fit at the goal, however it faces",
              true};
    const auto begun = std::chrono::steady_clock::now();
    const auto left = [&] {
      const std::chrono::duration<double> gone = std::chrono::steady_clock::now() - begun;
      return options_.time_limit - gone.count();
    };
    PlannedPosePath best;
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; (i < options_.attempts || best.path.empty()) && left() > 0; ++i) {
      const auto found = search_poses(map_, room, start, goals, guide.points, options_,
                                      attempt(i, left(), options_));
      if (found.path.empty() || found.cost >= least || !room.is_free(found.path, fine_step))
        continue;
      best.path = found.path;
      least = found.cost;
    }
    if (best.path.empty())
      best.reason =
        fmt::format("no way was found for the robot's footprint within {:.1f} s, though "
                    "there may be one",
                    options_.time_limit);
    return best;
  }

private:
  /// Which margin the start has, at most that of the options; negative if the robot touches
  /// something there.
  double margin_at(const Pose2& start) const {
    constexpr double step = 0.01; // metres
    for (double margin = options_.margin; margin > 0; margin -= step)
      if (FootprintRoom(clearance_, footprint_, margin).at(start) > 0)
        return margin;
    return FootprintRoom(clearance_, footprint_, 0).at(start) > 0 ? 0 : -1;
  }

  /// The way of a disc that fits into the footprint: if it has none, neither has the footprint.
  PlannedPath guide_to(const Pose2& start, const Point2& goal, double margin) const {
    PlanOptions options;
    // A cell less: the way of a disc leads from one cell's middle to another.
    options.radius = std::max(0.0, footprint_.inner_radius() + margin - map_.cell_size);
    options.margin = 0;
    options.preferred_clearance = footprint_.outer_radius() + margin;
    options.cells = options_.cells;
    return plan_path(map_, clearance_, {start.x, start.y}, goal, options);
  }

  static std::vector<Pose2> goals_at(const Point2& goal, std::optional<double> heading,
                                     const FootprintRoom& room) {
    std::vector<Pose2> result;
    constexpr int directions = 24;
    for (int i = 0; i < (heading ? 1 : directions); ++i) {
      const Pose2 x{goal.x, goal.y,
                    normalised(heading.value_or(2 * std::numbers::pi * i / directions))};
      if (room.at(x) > 0)
        result.push_back(x);
    }
    return result;
  }

  const CellMap& map_;
  const ClearanceMap& clearance_;
  const Footprint& footprint_;
  const PosePlanOptions& options_;
};

} // namespace

PlannedPosePath plan_poses(const CellMap& map, const ClearanceMap& clearance,
                           const Footprint& footprint, const Pose2& start, const Point2& goal,
                           std::optional<double> heading, const PosePlanOptions& options) {
  return PosePlanner(map, clearance, footprint, options).plan(start, goal, heading);
}

} // namespace castor::mapping
