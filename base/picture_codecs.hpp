#pragma once

#include "castor/base/pixels.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace castor {

/// What libcastor_picture_codecs has for picture_files.hpp, by its function
/// `const PictureCodecs* castor_picture_codecs()`.
struct PictureCodecs {
  Pixels<std::uint8_t> (*decode)(std::span<const std::uint8_t> file);
  Pixels<double> (*decode_unchanged)(std::span<const std::uint8_t> file);
  std::vector<std::uint8_t> (*encode_png)(int width, int height, int channels,
                                          std::span<const std::uint8_t> values);
};

} // namespace castor
