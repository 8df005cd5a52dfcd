#pragma once

#include "castor/mapping/building/building.hpp"
#include "castor/mapping/building/obstacles.hpp"
#include "castor/mapping/graph/graph_evaluation.hpp"
#include "castor/mapping/graph/graph_keeper.hpp"
#include "castor/mapping/slam/types.hpp"

#include <cstdint>
#include <vector>

namespace castor::mapping {

struct TourOptions {
  std::uint64_t seed = 1;
  bool people = false;
  /// Field of view of the laser, degrees.
  int laser = 180;
  /// Poses by SLAM, with its corrections; without, the true ones.
  bool slam = true;
};

/// What a simulated robot got on its way through a building.
struct Tour {
  struct Step {
    Keyframe keyframe;
    Pose2 truth;
    /// Poses in the map of all keyframes so far, where the graph was computed anew; else empty.
    std::vector<Pose2> corrected;
    Pose2 pose;
  };
  std::vector<Step> steps;
  std::int64_t collisions = 0;
  double driven = 0;
};

/// Drives along the path, which has a waypoint.
Tour drive_tour(const Building& building, const std::vector<Point2>& path,
                const TourOptions& options);

/// Gives the tour to a keeper, as the component would, and returns the time that it took, seconds.
double add_tour(GraphKeeper& keeper, const Tour& tour);

/// Doors of the building in the frame of the map, and whether the robot has seen them: from at most
/// 3 m, less than 45 degrees aside, with nothing in between.
std::vector<TrueDoor> doors_of(const Building& building, const Tour& tour);

/// The graph against the building; the map's frame is the building's, moved to the robot's start.
GraphQuality evaluate_tour(const GraphKeeper& keeper, const Building& building, const Tour& tour);

} // namespace castor::mapping
