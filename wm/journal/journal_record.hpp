#pragma once

#include "castor/wm/entries/change_event.hpp"
#include "castor/wm/entries/entry.hpp"
#include "castor/wm/store/store_image.hpp"
#include "castor/wm/values/value.hpp"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace castor {

/// A working memory that has lost acknowledged writes gets another incarnation. All that it then
/// numbers begins at another multiple of this, so that no number comes twice for different things.
inline constexpr std::uint64_t numbers_per_incarnation = 1'000'000'000'000;

/// A change, as it stands in a journal.
struct JournalRecord {
  /// As in the change event.
  std::uint64_t sequence = 0;
  /// The sequence number of the first change of the same write.
  std::uint64_t write = 0;
  /// The working memory's life: a journal's sessions count from 1.
  std::uint64_t session = 0;
  UnixTime time{0};
  Operation operation = Operation::add;
  std::string id;
  TypeDescriptorPtr type;
  Version version = 0;
  /// The component that made the change.
  std::string source;
  EntryLife life;
  /// Of an overwrite. Found by who writes the journal, from `before`.
  FieldMask changed = 0;
  /// The entry's content after the change; none for a deletion.
  Value value;
  /// That before an overwrite; not written down.
  Value before;
};

/// The record of a change that has just been committed; `before` for an overwrite. The write that
/// it is part of is its own, the time is counted from `began`.
JournalRecord record_of(const ChangeEvent& event, const Entry& entry, const EntryPtr& before,
                        UnixTime began);

/// The changes of one write: either all are in the journal, or none.
using JournalGroup = std::vector<JournalRecord>;
using JournalGroupPtr = std::shared_ptr<JournalGroup>;

} // namespace castor
