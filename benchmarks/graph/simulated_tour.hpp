#pragma once

#include "castor/mapping/building/building.hpp"
#include "castor/mapping/building/obstacles.hpp"
#include "castor/mapping/graph/graph_evaluation.hpp"
#include "castor/mapping/graph/graph_keeper.hpp"
#include "castor/mapping/slam/types.hpp"

#include <cstdint>
#include <string>
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
/// @param rooms whether rooms of the grid are a second source, each 10 s of the tour
double add_tour(GraphKeeper& keeper, const Tour& tour, bool rooms);

/// Doors of the building, and whether a robot has seen them: from at most 3 m, less than 45 degrees
/// aside, with nothing in between.
/// @param path true poses of the robot in the building
/// @param frame of the map, in that of the building; the doors are in that of the map
std::vector<TrueDoor> doors_of(const Building& building, const std::vector<Pose2>& path,
                               const Pose2& frame);

/// Nodes of a graph against the building.
GraphQuality evaluate_nodes(const std::vector<GraphNode>& nodes, const Building& building,
                            const std::vector<Pose2>& path, const Pose2& frame);

/// True poses at the keyframes.
std::vector<Pose2> true_path(const Tour& tour);

/// A line on a graph, below the names of its columns, and what is wrong with it.
void print_columns();
void print_quality(const std::string& name, const GraphQuality& x, const Pose2& frame);

} // namespace castor::mapping
