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

/// Persistent content of a working memory.
struct StoreImage {
  struct Written {
    EntryPtr entry;
    /// Sequence number of its last change.
    std::uint64_t sequence = 0;
    UnixTime time{0};
  };

  /// In the order of their last writes.
  std::vector<Written> entries;
  /// Deleted ids with their last versions, the oldest deletion first.
  std::vector<std::pair<std::string, Version>> deleted;
  /// Above the versions of all deleted ids that are no longer remembered.
  Version floor = 0;
  std::uint64_t sequence = 0;
};

} // namespace castor
