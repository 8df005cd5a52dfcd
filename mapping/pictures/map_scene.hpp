#pragma once

#include "castor/mapping/exploration/types.hpp"
#include "castor/mapping/exports/map_picture.hpp"
#include "castor/mapping/graph/types.hpp"
#include "castor/mapping/movement/types.hpp"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace castor::mapping {

/// What is known of a building beside its grid; each may be empty.
struct MapKnowledge {
  std::vector<Pose2> trajectory;
  std::vector<GraphNode> nodes;
  std::vector<GraphEdge> edges;
  std::vector<Area> areas;
  /// Where people were seen, in the order of time, by their ids.
  std::map<std::int64_t, std::vector<Pose2>> people;
  std::vector<ExplorationState> explorations;
  std::vector<Movement> movements;
};

/// Lines and marks to draw over the grid.
struct MapScene {
  std::vector<MapTrack> tracks;
  std::vector<MapMark> marks;
  /// For people: "trajectory, 12 nodes of 3 areas".
  std::string content;
};

/// The trajectory is red, nodes and edges have the colour of their area, which differs from those
/// of areas behind its gateways; its label (or "area 3") is at the place nearest to its middle;
/// gateways are black; people's tracks are violet, the planned path is green, and frontiers are
/// orange, or grey if they cannot be reached.
MapScene map_scene(const MapKnowledge& knowledge);

} // namespace castor::mapping
