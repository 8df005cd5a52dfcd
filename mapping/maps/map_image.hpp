#pragma once

#include <filesystem>
#include <vector>

namespace castor::mapping {

/// The image of a map, rows from above.
struct MapImage {
  int width = 0;
  int height = 0;
  /// 0 to 255; the mean of the colour channels.
  std::vector<double> grey;
  /// Whether a pixel is transparent, even in part; empty for images without an alpha channel.
  std::vector<bool> transparent;
};

/// @throws MapFileError if there is no such file, or it is no image, or is damaged
MapImage read_map_image(const std::filesystem::path& path);

} // namespace castor::mapping
