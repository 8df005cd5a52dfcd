#pragma once

#include "castor/mapping/grid/cell_map.hpp"
#include "castor/mapping/rooms/room_segmentation.hpp"

#include <cstdint>
#include <vector>

/// Known methods of room segmentation, to compare ours with. Each returns the number of each cell's
/// room, or 0, as SegmentedRooms has it, and removes small furniture as ours does.
namespace castor::mapping {

/// Areas of rooms, square metres; those with which Bormann et al. (2016) compare the methods.
struct RoomAreas {
  double smallest = 0.8;
  double largest = 47.0;
};

/// The morphological method: walls grow by a cell at a time, and what is then apart is a room as
/// soon as its area is between the limits; the rest goes to the room that is nearest by way.
std::vector<std::int32_t> rooms_by_erosion(const CellMap& map, const RoomOptions& options,
                                           const RoomAreas& areas = {});

/// The distance transform method: the threshold of the clearance that leaves the greatest number of
/// parts above the smallest area; the rest goes to the part that is nearest by way.
std::vector<std::int32_t> rooms_by_threshold(const CellMap& map, const RoomOptions& options,
                                             const RoomAreas& areas = {});

/// Basins of the clearance as ours, with the watershed's boundaries in place of straight ones.
std::vector<std::int32_t> rooms_by_watershed(const CellMap& map, const RoomOptions& options);

} // namespace castor::mapping
