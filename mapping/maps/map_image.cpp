#include "castor/mapping/maps/map_image.hpp"

#include "castor/base/input_file.hpp"
#include "castor/base/picture_files.hpp"
#include "castor/mapping/maps/map_file_error.hpp"

#include <cstdint>
#include <numeric>

namespace castor::mapping {

MapImage read_map_image(const std::filesystem::path& path) {
  Pixels<double> picture;
  try {
    const InputFile file{path};
    const auto bytes = file.read(file.size());
    picture =
      decode_picture_unchanged({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()});
  } catch (const InputFileError& e) {
    throw MapFileError(path.string(), 0, {}, e.what(),
                       "Put the image there, or correct its name; it is sought from the folder of "
                       "the .yaml.");
  }
  if (picture.values.empty())
    throw MapFileError(path.string(), 0, {}, "it is no image, or is damaged",
                       "Use a .pgm or .png that other programs can open.");
  const int channels = picture.channels;
  // The last of two or four channels is transparency.
  const bool has_alpha = channels % 2 == 0;
  const int colours = has_alpha ? channels - 1 : channels;
  MapImage result{picture.width, picture.height, {}, {}};
  for (auto x = picture.values.begin(); x != picture.values.end(); x += channels) {
    result.grey.push_back(std::accumulate(x, x + colours, 0.) / colours);
    if (has_alpha)
      result.transparent.push_back(x[colours] < 255);
  }
  return result;
}

} // namespace castor::mapping
