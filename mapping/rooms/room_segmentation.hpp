#pragma once

#include "castor/mapping/grid/cell_map.hpp"
#include "castor/mapping/planar/poses.hpp"

#include <cstdint>
#include <vector>

namespace castor::mapping {

struct RoomOptions {
  /// Diagonal up to which what stands by itself in a room is furniture, not a wall; metres.
  double largest_furniture = 1.0;
  /// Two spaces are two rooms if the opening between them is narrower than this share of the
  /// lesser one's width (as the largest discs that fit into each). Below the square root of 1/2, a
  /// corridor between two crossings with equally wide ones is not divided.
  double neck_ratio = 0.7;
  /// Openings that are narrower are gaps of walls, not cut straight; metres.
  double narrowest_opening = 0.3;
  /// What is smaller belongs to the room that it is most open to; square metres.
  double smallest_room = 1.5;
  /// Percent up to which a cell is free.
  int free_to = 45;
};

/// Where two rooms meet: a door, or a passage.
struct RoomOpening {
  /// The rooms' numbers; the lesser one first.
  std::int32_t a = 0;
  std::int32_t b = 0;
  /// Its ends at the walls, in the frame of the map.
  Point2 from;
  Point2 to;
  /// Metres.
  double width = 0;
};

struct SegmentedRoom {
  /// From 1, in the order of their lowest cells.
  std::int32_t number = 0;
  /// Corners in the frame of the map, anticlockwise seen from above; without the holes.
  std::vector<Point2> outline;
  /// Where there is most room: the cell that is farthest from walls.
  Point2 centre;
  /// Greatest distance from walls, that of `centre`; metres.
  double clearance = 0;
  /// Square metres, with the small furniture in it.
  double area = 0;
  /// Numbers of the rooms that an opening leads to, in order.
  std::vector<std::int32_t> neighbours;
};

struct SegmentedRooms {
  /// Number of the room of each cell of the map, or 0; row by row from below.
  std::vector<std::int32_t> labels;
  std::vector<SegmentedRoom> rooms;
  std::vector<RoomOpening> openings;
};

/// Divides the free space of a map into rooms: basins of the distance from walls, with straight
/// boundaries from wall to wall at the necks between them. A map without free cells has no rooms.
/// @throws std::invalid_argument for options out of their range, or a map with cells of no size
SegmentedRooms segment_rooms(const CellMap& map, const RoomOptions& options = {});

} // namespace castor::mapping
