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
  /// width * height * channels; as long as the value lives that they come from.
  std::span<const std::uint8_t> bytes;
};

/// What in a value may lead to other entries, and the pictures in it, at whatever depth.
struct Contents {
  std::vector<Address> addresses;
  /// Strings that are no part of an address, each once: any of them may be the id of an entry.
  std::vector<std::string> texts;
  std::vector<PictureView> pictures;
};

/// Of a value that is not what its type says: what was found up to there.
Contents contents_of(const Value& x);

} // namespace castor::timeline
