#pragma once

#include "castor/wm/journal/journal_record.hpp"
#include "castor/wm/store/tombstones.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <unordered_map>

namespace castor {

/// The state that results from a journal's changes. Throws JournalCorrupt at impossible changes.
class JournalImage {
public:
  explicit JournalImage(std::string subarchitecture, std::size_t remembered_deletions = 100'000)
    : subarchitecture_(std::move(subarchitecture)), tombstones_(remembered_deletions) {}

  // -- folded entries and deletions, each in the order of writing
  void add_folded(JournalRecord record);
  void add_deleted(const std::string& id, Version version, std::uint64_t sequence);
  void raise_floor(Version floor) { tombstones_.raise_floor(floor); }

  /// Applies the next change that was not folded.
  void apply(JournalRecord record);

  /// Begins an incarnation of the working memory; no effect if it is the present one.
  void begin_incarnation(std::uint64_t number);

  /// Sequence number of the last change.
  std::uint64_t sequence() const { return sequence_; }
  void set_sequence(std::uint64_t sequence) { sequence_ = sequence; }
  std::size_t size() const { return entries_.size(); }

  StoreImage store() const;

private:
  /// Version of an entry in the present incarnation.
  Version version_of(const JournalRecord& x) const;

  std::string subarchitecture_;
  std::unordered_map<std::string, JournalRecord> entries_;
  Tombstones tombstones_;
  std::uint64_t sequence_ = 0;
  /// First number of the present incarnation.
  std::uint64_t base_ = 0;
};

} // namespace castor
