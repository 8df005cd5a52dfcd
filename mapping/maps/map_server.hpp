#pragma once

#include "castor/mapping/grid/cell_map.hpp"
#include "castor/mapping/planar/types.hpp"

#include <filesystem>
#include <string>
#include <string_view>

/// Map files of ROS's map_server: a `.yaml` beside an image.
namespace castor::mapping {

/// How a grey value is read. With p = (255 - grey) / 255, or grey / 255 if the map is negated:
enum class MapMode {
  /// Occupied above one threshold, free below the other, else unknown.
  trinary,
  /// The same, but values in between are probabilities; only transparent pixels are unknown.
  scale,
  /// The grey value is the probability in percent; unknown above 100.
  raw
};

/// The contents of the `.yaml`.
struct MapServerFile {
  /// Absolute, or relative to the folder of the `.yaml`.
  std::string image;
  /// Metres for a pixel.
  double resolution = 0;
  /// Of the lower left corner of the image.
  Pose2 origin;
  bool negate = false;
  double occupied_threshold = 0.65;
  double free_threshold = 0.196;
  MapMode mode = MapMode::trinary;
};

/// Parses the text of a `.yaml`; unknown keys are ignored.
/// @throws MapFileError with all problems: missing keys, values that are no numbers, a resolution
/// that is not positive, thresholds out of order
MapServerFile parse_map_server(std::string_view text, const std::string& file_name);

/// Reads a map: the `.yaml`, and the image that it names (`.pgm`, `.png`, and what else OpenCV
/// reads). A colour counts as the mean of its channels, as in map_server.
/// @throws MapFileError also if a file cannot be read
CellMap read_map_server(const std::filesystem::path& yaml);

/// The classes of a map that is written in the mode `trinary`: what is in between is unknown.
struct MapClasses {
  /// Percent.
  int occupied_from = 60;
  int free_to = 45;
};

/// Writes `<stem>.yaml` and `<stem>.pgm` in the mode `trinary`, with the thresholds and grey values
/// of ROS's map_saver: 0 occupied, 254 free, 205 unknown.
/// @throws MapFileError if a file cannot be written, or the map has no cells
void write_map_server(const CellMap& map, const std::filesystem::path& stem,
                      const MapClasses& classes = {});

} // namespace castor::mapping
