#pragma once

#include "castor/mapping/grid/cell_map.hpp"
#include "castor/mapping/rooms/room_segmentation.hpp"

#include <cstdint>
#include <vector>

namespace castor::mapping {

/// A map with its rooms as a PNG file, a pixel for each cell, north up: rooms in colours with their
/// numbers at their centres, what is blocked in them darker, openings as red lines, the rest black.
/// @throws std::runtime_error for a map without cells
std::vector<std::uint8_t> picture_of(const CellMap& map, const SegmentedRooms& rooms);

} // namespace castor::mapping
