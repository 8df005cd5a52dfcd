#pragma once

#include "castor/mapping/grid/cell_map.hpp"
#include "castor/mapping/rooms/raster.hpp"

#include <cstdint>

namespace castor::mapping {

/// Distance of each free cell's centre from that of the nearest cell that is not free, in cells; 0
/// where a cell is not free, and in the margin. Unknown cells are not free.
///
/// Cells that are not free count as free where they make up something small that stands by itself:
/// neither joined to anything larger nor at the edge of the map, with a bounding box whose diagonal
/// is at most `largest_furniture` (metres). These are legs of tables, bins, and noise.
/// @param free_to percent up to which a cell is free
Raster<float> clearance(const CellMap& map, double largest_furniture, int free_to);

} // namespace castor::mapping
