#pragma once

#include "castor/base/pixels.hpp"

#include <cstdint>
#include <span>
#include <vector>

/// Pictures as files have them. OpenCV's codecs, which do that, bring some 150 libraries with them,
/// which take longer to load than a small system takes to start; so they are in a library of their
/// own, which is loaded with the first picture. Each function throws std::runtime_error if that
/// cannot be loaded.
namespace castor {

/// A picture in any usual format, in 8-bit B, G, R; turned upright, without transparency. Without
/// pixels if it cannot be decoded.
Pixels<std::uint8_t> decode_picture(std::span<const std::uint8_t> file);

/// The same with the channels and depth of the file, from 0 to 255, and as the file has it.
Pixels<double> decode_picture_unchanged(std::span<const std::uint8_t> file);

/// @param values as those of Pixels, 1 or 3 channels
/// \throws std::runtime_error with the reason if they cannot be encoded
std::vector<std::uint8_t> encode_png(int width, int height, int channels,
                                     std::span<const std::uint8_t> values);

} // namespace castor
