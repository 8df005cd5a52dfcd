#pragma once

#include "castor/base/caf.hpp"
#include "castor/wm/journal/journal.hpp"
#include "castor/wm/leases/lease_table.hpp"
#include "castor/wm/store/entry_store.hpp"

#include <chrono>
#include <cstdint>
#include <memory>
#include <set>
#include <string>

namespace castor {

/// The versions and tokens of a working memory without a journal begin at another multiple of this
/// in each of its lives, so that none comes twice for different things.
inline constexpr std::uint64_t numbers_per_life = std::uint64_t{1} << 32;

struct WorkingMemoryOptions {
  std::string subarchitecture;
  /// Subarchitectures whose components may write here besides its own; "*" for all.
  std::set<std::string> writers;
  /// Changes in these subarchitectures are not told to the components of this one.
  std::set<std::string> ignored;
  /// Which of its lives this is. Versions and tokens of a later one are above those of the lives
  /// before, so that nobody takes an entry for one that is gone.
  std::uint64_t incarnation = 1;
  /// The moment that event times count from.
  std::chrono::steady_clock::time_point epoch{};
  /// Every event is sent to every other working memory, wanted or not.
  bool broadcast = false;
  /// How long another working memory may take to take note of a filter.
  std::chrono::milliseconds peer_deadline{5000};
  EntryStoreOptions store;
  LeaseTableOptions leases;
  JournalOptions journal;
  /// The journal, with what it held; without, there is none.
  std::shared_ptr<OpenedJournal> opened_journal;
  /// Who takes JournalWrite and answers with JournalNews, instead of an actor that writes the
  /// journal's file.
  caf::actor journal_writer;
};

} // namespace castor
