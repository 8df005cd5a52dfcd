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

/// A working memory that has lost acknowledged writes gets another incarnation. All its numbers
/// then begin at another multiple of this, so that no number is used twice for different things.
inline constexpr std::uint64_t numbers_per_incarnation = 1'000'000'000'000;

/// A change in a journal.
struct JournalRecord {
  /// As in the change event.
  std::uint64_t sequence = 0;
  /// The sequence number of the first change of the same write.
  std::uint64_t write = 0;
  /// Session of the working memory, counted from 1 in each journal.
  std::uint64_t session = 0;
  UnixTime time{0};
  Operation operation = Operation::add;
  std::string id;
  TypeDescriptorPtr type;
  Version version = 0;
  /// The component that made the change.
  std::string source;
  EntryLife life;
  /// Fields changed by an overwrite. Determined by the journal writer, from `before`.
  FieldMask changed = 0;
  /// The entry's content after the change; none for a deletion.
  Value value;
  /// Content before an overwrite; not written to the file.
  Value before;
};

/// The record of a change that has just been committed, as a write of its own; `before` for an
/// overwrite. Event times count from `began`.
JournalRecord record_of(const ChangeEvent& event, const Entry& entry, const EntryPtr& before,
                        UnixTime began);

/// The changes of one write: all are in the journal, or none.
using JournalGroup = std::vector<JournalRecord>;
using JournalGroupPtr = std::shared_ptr<JournalGroup>;

} // namespace castor
