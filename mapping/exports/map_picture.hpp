#pragma once

#include "castor/mapping/grid/cell_map.hpp"
#include "castor/mapping/planar/poses.hpp"
#include "castor/mapping/planar/types.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace castor::mapping {

/// A line over the picture of a map.
struct MapTrack {
  std::vector<Pose2> poses;
  /// Red, green, blue.
  std::uint8_t red = 0xD0;
  std::uint8_t green = 0x30;
  std::uint8_t blue = 0x30;
  /// Pixels.
  int width = 2;
  /// Whether there is a dot at its start and an arrow at its end.
  bool has_ends = true;
};

/// A dot over the picture of a map, and the text beside it.
struct MapMark {
  Point2 place;
  std::uint8_t red = 0;
  std::uint8_t green = 0;
  std::uint8_t blue = 0;
  /// Pixels; 0: only the text.
  int radius = 4;
  std::string text;
};

struct MapPictureOptions {
  /// Length of the longer side, about; pixels. Cells are enlarged or reduced by a whole number.
  int side = 1200;
};

/// Pixels in rows from the top, each of blue, green and red.
struct MapPixels {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> bytes;
};

/// The map, light where it is free and dark where it is occupied, and the tracks and marks over it,
/// and a bar of round length for the scale. The map is enlarged so that all tracks are in the
/// picture.
/// @throws std::invalid_argument if there is neither a cell nor a pose
MapPixels map_pixels(const CellMap& map, const std::vector<MapTrack>& tracks,
                     const MapPictureOptions& options = {}, const std::vector<MapMark>& marks = {});

/// The same as the bytes of a PNG file.
std::string map_picture(const CellMap& map, const std::vector<MapTrack>& tracks,
                        const MapPictureOptions& options = {},
                        const std::vector<MapMark>& marks = {});

} // namespace castor::mapping
