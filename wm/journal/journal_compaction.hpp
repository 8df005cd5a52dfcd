#pragma once

#include "castor/wm/entries/change_event.hpp"
#include "castor/wm/entries/entry.hpp"
#include "castor/wm/journal/journal_tables.hpp"
#include "castor/wm/journal/sqlite.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace castor {

/// Keeps a journal's file small by folding the oldest changes into the entries that resulted from
/// them.
class JournalCompaction {
public:
  JournalCompaction(sqlite::Database& database, std::size_t remembered_deletions)
    : database_(database), remembered_deletions_(remembered_deletions) {}

  /// Folds some of the oldest changes, for some milliseconds, and updates `meta`. To be called in a
  /// transaction that writes `meta`.
  void fold(journal_tables::Meta& meta);

private:
  struct OldChange {
    std::uint64_t sequence = 0;
    Operation operation = Operation::add;
    Version version = 0;
    std::uint64_t checksum = 0;
    std::string id;
  };

  std::vector<OldChange> oldest_changes();

  /// Applies one change to the folded entries.
  void fold(journal_tables::Meta& meta, const OldChange& x);

  /// Adds a deletion to the remembered ones; may remove the oldest.
  void remember_deletion(journal_tables::Meta& meta, const OldChange& x);

  void remove_row(const std::string& table, const std::string& id, std::uint64_t& count,
                  std::uint64_t& sum);

  sqlite::Database& database_;
  std::size_t remembered_deletions_;
};

} // namespace castor
