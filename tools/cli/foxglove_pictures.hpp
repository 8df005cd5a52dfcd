#pragma once

#include "castor/wm/values/value.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace castor::cli {

/// A picture in a value, encoded.
struct Picture {
  /// Path of its record within the value: "/image"; empty for the value itself.
  std::string path;
  /// "png" or "jpeg", for example.
  std::string format;
  std::string bytes;
  /// Checksum of the picture.
  std::uint32_t checksum = 0;
};

/// The pictures of a value, except those in lists: records of pixels, which are encoded as PNG, and
/// records of an encoded picture and its format. Throws DecodeError if the value does not match its
/// type.
std::vector<Picture> pictures_in(const Value& x);

} // namespace castor::cli
