#pragma once

#include "castor/wm/journal/journal_record.hpp"
#include "castor/wm/store/tombstones.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <unordered_map>

namespace castor {

/// What a journal's changes lead to. Throws JournalCorrupt at changes that cannot have happened.
class JournalImage {
public:
  explicit JournalImage(std::string subarchitecture, std::size_t remembered_deletions = 100'000)
    : subarchitecture_(std::move(subarchitecture)), tombstones_(remembered_deletions) {}

  // -- what was folded, each in the order in which it was written
  void add_folded(JournalRecord record);
  void add_deleted(const std::string& id, Version version, std::uint64_t sequence);
  void raise_floor(Version floor) { tombstones_.raise_floor(floor); }

  /// The next of the changes that were not.
  void apply(JournalRecord record);

  /// From here on the working memory has another incarnation; nothing if it has it already.
  void begin_incarnation(std::uint64_t number);

  /// The number of the last change.
  std::uint64_t sequence() const { return sequence_; }
  void set_sequence(std::uint64_t sequence) { sequence_ = sequence; }
  std::size_t size() const { return entries_.size(); }

  StoreImage store() const;

private:
  /// The version of an entry as it counts now.
  Version version_of(const JournalRecord& x) const;

  std::string subarchitecture_;
  std::unordered_map<std::string, JournalRecord> entries_;
  Tombstones tombstones_;
  std::uint64_t sequence_ = 0;
  /// The first of this incarnation's numbers.
  std::uint64_t base_ = 0;
};

} // namespace castor
