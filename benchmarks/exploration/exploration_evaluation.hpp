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

/// A length, metres, that no path is shorter than by which a robot sees every point of the floor
/// that its footprint can cover. Each point is seen from a region of the floor, and a path visits
/// all regions and begins at the start; so it is not shorter than the minimal spanning tree of the
/// start and of some regions, where the distance of two regions is the least between any two of
/// their points. The regions are those of points that are seen from few places, and do not overlap.
/// Ways over cells are up to 1.083 times as long as true ones, and are divided by that; regions are
/// known to 0.2 m. Takes some seconds.
/// @param sight range of the robot's laser, metres
double shortest_exploration(const Building& building, const ReachableFloor& floor, double sight);

} // namespace castor::mapping
