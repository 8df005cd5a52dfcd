#include "castor/base/picture_files.hpp"

#include "castor/base/picture_codecs.hpp"
#include "castor/base/sibling_library.hpp"

namespace castor {

namespace {

const PictureCodecs& codecs() {
  static const auto& result = *reinterpret_cast<const PictureCodecs* (*)()>(
    function_of_sibling("picture_codecs", "castor_picture_codecs"))();
  return result;
}

} // namespace

Pixels<std::uint8_t> decode_picture(std::span<const std::uint8_t> file) {
  return codecs().decode(file);
}

Pixels<double> decode_picture_unchanged(std::span<const std::uint8_t> file) {
  return codecs().decode_unchanged(file);
}

std::vector<std::uint8_t> encode_png(int width, int height, int channels,
                                     std::span<const std::uint8_t> values) {
  return codecs().encode_png(width, height, channels, values);
}

} // namespace castor
