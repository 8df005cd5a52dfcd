#pragma once

#include "castor/base/caf.hpp"

#include <cstdint>
#include <string>

namespace castor {

/// From the journal to its working memory: how it stands.
struct JournalNews {
  /// Up to this change everything is safe.
  std::uint64_t synced = 0;
  /// What the file takes.
  std::uint64_t bytes = 0;
  /// How often something was synced.
  std::uint64_t syncs = 0;
  /// Why it takes nothing more; empty as long as it does.
  std::string failure = {};
};

} // namespace castor

CASTOR_LOCAL_MESSAGE(castor::JournalNews)
