#pragma once

#include "castor/mapping/body/simulated_body.hpp"

#include <filesystem>

namespace castor::mapping {

/// A map of ROS's map_server as the building that a robot drives in: occupied cells are walls, at
/// all heights. The start is the map's origin.
/// \throws MapFileError if the map cannot be read, std::invalid_argument if it is turned.
BodySurroundings surroundings_in_map(const std::filesystem::path& yaml);

} // namespace castor::mapping
