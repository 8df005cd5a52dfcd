#pragma once

#include "castor/mapping/exports/map_contents.hpp"
#include "castor/mapping/grid/types.hpp"
#include "castor/mapping/map_components/types.hpp"
#include "castor/mapping/octree/types.hpp"

#include <filesystem>
#include <span>

namespace castor::mapping {

/// Writes all files of a map into a folder, which is made if it does not exist: map.yaml with
/// map.pgm, map.png, keyframes.g2o, corrected.log, map.ot and map.bt. What there is nothing for is
/// left out, and said.
/// @param truth where the robot truly was, for the picture; may be empty
/// @throws std::runtime_error if a file cannot be written, or an entry is damaged
ExportedMap write_map_files(const std::filesystem::path& folder, const MapContents& contents,
                            std::span<const GridTile> tiles, std::span<const OctreeBlock> blocks,
                            std::span<const Pose2> truth = {});

} // namespace castor::mapping
