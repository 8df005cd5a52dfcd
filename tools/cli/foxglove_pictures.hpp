#pragma once

#include "castor/wm/values/value.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace castor::cli {

/// A picture in a value, encoded.
struct Picture {
  /// Of the record that it is: "/image"; empty for the value itself.
  std::string path;
  /// "png" or "jpeg", for example.
  std::string format;
  std::string bytes;
  /// Equal for equal pictures.
  std::uint32_t checksum = 0;
};

/// The pictures of a value, those in lists apart: records of pixels, which become PNG, and records
/// that hold an encoded picture and say of which format. Throws DecodeError if the value is not
/// what its type says.
std::vector<Picture> pictures_in(const Value& x);

} // namespace castor::cli
