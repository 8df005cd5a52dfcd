#pragma once

#include "castor/mapping/building/building.hpp"
#include "castor/mapping/building/reachable_floor.hpp"
#include "castor/mapping/grid/cell_map.hpp"

/// How well a building was explored, by what is known of the true one.
namespace castor::mapping {

/// Shares of the floor that the robot's footprint can cover, 0 to 1.
struct SeenFloor {
  /// Known to the map, as free or as occupied.
  double known = 0;
  /// Free on the map. Cells in which a wall begins are occupied on the best of maps, so that this
  /// stays below 1.
  double free = 0;
  /// Free on the map, of the cells that no obstacle reaches into.
  double free_of_open = 0;
};

/// What a map has of the floor.
/// @param frame of the map, in that of the building
SeenFloor seen_floor(const Building& building, const ReachableFloor& floor, const CellMap& map,
                     const Pose2& frame);

/// A length, metres, that no path is shorter than by which a robot sees a point of each room that
/// it can reach: that of its reachable floor which is farthest from the start. Each such point is
/// seen from a region of the floor, and a path visits all regions and begins at the start; so it is
/// not shorter than the minimal spanning tree of the start and the regions, where the distance of
/// two regions is the least between any two of their points. Ways over cells are up to 1.083 times
/// as long as true ones, and are divided by that.
/// @param sight range of the robot's laser, metres
double shortest_exploration(const Building& building, const ReachableFloor& floor, double sight);

} // namespace castor::mapping
