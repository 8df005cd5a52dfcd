#pragma once

#include "castor/mapping/body/simulated_body.hpp"
#include "castor/mapping/grid/cell_map.hpp"

#include <filesystem>

namespace castor::mapping {

/// A map of ROS's map_server as the building that a robot drives in: occupied cells are walls, at
/// all heights. The start is the map's origin.
/// \throws MapFileError if the map cannot be read, std::invalid_argument if it is turned.
BodySurroundings surroundings_in_map(const std::filesystem::path& yaml);

/// The same of a map that was read already; it is not turned.
BodySurroundings surroundings_in_map(const CellMap& map);

} // namespace castor::mapping
