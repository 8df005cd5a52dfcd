#pragma once

#include "castor/base/caf.hpp"

#include <cstdint>
#include <string>

namespace castor {

/// Message from the journal to its working memory: its progress.
struct JournalNews {
  /// Sequence number up to which all changes are on disk.
  std::uint64_t synced = 0;
  /// Size of the file, in bytes.
  std::uint64_t bytes = 0;
  /// Number of syncs.
  std::uint64_t syncs = 0;
  /// Reason why it cannot write any more; else empty.
  std::string failure = {};
};

} // namespace castor

CASTOR_LOCAL_MESSAGE(castor::JournalNews)
