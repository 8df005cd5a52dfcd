#pragma once

#include "castor/wm/entries/address.hpp"
#include "castor/wm/values/value.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace castor::timeline {

/// Pixels in rows from the top, as the reflected type Image has them: 1 channel is grey, 3 are
/// blue, green and red.
struct PictureView {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint32_t channels = 0;
  /// width * height * channels bytes. Valid as long as the value that contains them.
  std::span<const std::uint8_t> bytes;
};

/// Possible references to other entries in a value, and its pictures, at any depth.
struct Contents {
  std::vector<Address> addresses;
  /// Distinct strings that are not part of an address: any of them may be the id of an entry.
  std::vector<std::string> texts;
  std::vector<PictureView> pictures;
};

/// For a value that does not match its type: the contents up to the error.
Contents contents_of(const Value& x);

} // namespace castor::timeline
