#pragma once

#include "castor/base/caf.hpp"
#include "castor/wm/clock/simulated_clock.hpp"
#include "castor/wm/journal/journal.hpp"
#include "castor/wm/leases/lease_table.hpp"
#include "castor/wm/store/entry_store.hpp"

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <string>

namespace castor {

/// The versions and tokens of a working memory without a journal begin at another multiple of this
/// at each start, so that no number is used twice for different things.
inline constexpr std::uint64_t numbers_per_life = std::uint64_t{1} << 32;

struct WorkingMemoryOptions {
  std::string subarchitecture;
  /// Other subarchitectures whose components may write here; "*" for all.
  std::set<std::string> writers;
  /// Other subarchitectures whose components may read here, "*" for all; nothing if no rule is
  /// about that, and everybody may.
  std::optional<std::set<std::string>> readers = {};
  /// Changes in these subarchitectures are not sent to the components of this one.
  std::set<std::string> ignored;
  /// Number of its start. Versions and tokens are above those of earlier starts, so that no entry
  /// is taken for an earlier one.
  std::uint64_t incarnation = 1;
  /// Origin of event times.
  std::chrono::steady_clock::time_point epoch{};
  /// Clock of event times and of times to live; null for the real one. Leases and waits are timed
  /// by the real one.
  std::shared_ptr<SimulatedClock> clock;
  /// Every event is sent to every other working memory, regardless of interests.
  bool broadcast = false;
  /// Another subarchitecture that gets no broadcasts, since it has no components.
  std::string without_components;
  /// Time limit for another working memory to register a filter.
  std::chrono::milliseconds peer_deadline{5000};
  EntryStoreOptions store;
  LeaseTableOptions leases;
  JournalOptions journal;
  /// The opened journal with its content; null without a journal.
  std::shared_ptr<OpenedJournal> opened_journal;
  /// Actor that receives JournalWrite and sends JournalNews, instead of one that writes the
  /// journal's file; may be null.
  caf::actor journal_writer;
};

} // namespace castor
