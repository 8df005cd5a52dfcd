#pragma once

#include "castor/wm/entries/entry.hpp"

#include <chrono>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace castor {

/// Time since 1970.
using UnixTime = std::chrono::microseconds;

/// What a working memory holds, without what only its process knows of it.
struct StoreImage {
  struct Written {
    EntryPtr entry;
    /// The number of its last change.
    std::uint64_t sequence = 0;
    UnixTime time{0};
  };

  /// The longest unwritten first.
  std::vector<Written> entries;
  /// With the last version that they had, the longest deleted first.
  std::vector<std::pair<std::string, Version>> deleted;
  /// Above every version that was forgotten.
  Version floor = 0;
  std::uint64_t sequence = 0;
};

} // namespace castor
