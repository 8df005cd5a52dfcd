#pragma once

#include "castor/mapping/movement/movers.hpp"
#include "castor/mapping/movement/planning_map.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace castor::mapping {

struct MapAlignmentOptions {
  /// Greatest correction: along x and y, metres; and of the heading, radians.
  double most = 0.4;
  double most_turn = 0.09;
  /// Steps of the search.
  double step = 0.05;
  double turn_step = 0.03;
  /// A point so far from an obstacle of the map counts by 0, and less the nearer it is; metres.
  double spread = 0.15;
  /// What a correction has to gain at least, as a share of the points, and the share that has to
  /// be on the map with it.
  double least_gain = 0.015;
  double least_share = 0.8;
  /// What each metre of a change, and each radian, has to gain besides.
  double gain_per_metre = 0.05;
  double gain_per_radian = 0.05;
  /// Fewer points tell nothing, and more take time.
  std::size_t least_points = 50;
  std::size_t most_points = 400;
};

/// By how much a map that is given is beside the frame of the poses: SLAM that begins anew in a
/// building turns and shifts a little against the map of before, and drifts for a while. It looks
/// where most of what the laser sees is on the map.
class MapAlignment {
public:
  explicit MapAlignment(const MapAlignmentOptions& options = {}) : options_(options) {}

  /// Looks anew. It keeps the correction that it has unless another one is clearly better.
  /// @param robot its pose without correction; `seen` and `movers` are in the frame of that pose
  void look(const Pose2& robot, std::span<const Point2> seen, std::span<const Mover> movers,
            const PlanningMap& map);

  /// The robot on the map, and what is at a point by its pose.
  Pose2 on_map(const Pose2& robot) const;
  Point2 on_map(const Pose2& robot, const Point2& point) const;

private:
  /// Whether nearly nothing is beside the map's obstacles.
  bool is_aligned(const std::vector<Point2>& turned, const Point2& robot,
                  const ClearanceMap& map) const;

  MapAlignmentOptions options_;
  /// To be added to the pose: how far a frame that drifts is off changes slowly on the way, so that
  /// this is not a turn of the whole frame, which would grow with the distance.
  Pose2 offset_;
};

} // namespace castor::mapping
