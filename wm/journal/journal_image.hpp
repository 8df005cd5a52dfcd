#pragma once

#include "castor/wm/journal/journal.hpp"

#include <cstddef>
#include <cstdint>
#include <list>
#include <string>
#include <unordered_map>

namespace castor {

/// What a journal's changes lead to. Throws JournalCorrupt at changes that cannot have happened.
class JournalImage {
public:
  explicit JournalImage(std::string subarchitecture, std::size_t remembered_deletions = 100'000)
    : subarchitecture_(std::move(subarchitecture)), remembered_(remembered_deletions) {}

  // -- what was folded, each in the order in which it was written
  void add_folded(JournalRecord record);
  void add_deleted(const std::string& id, Version version, std::uint64_t sequence);
  void set_floor(Version floor) { floor_ = floor; }

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
  struct Deleted {
    std::string id;
    Version version = 0;
    std::uint64_t sequence = 0;
  };

  /// A version as it counts now: those of earlier incarnations are over.
  Version raised(Version version, std::uint64_t sequence) const;
  void bury(const std::string& id, Version version, std::uint64_t sequence);

  std::string subarchitecture_;
  std::size_t remembered_;
  std::unordered_map<std::string, JournalRecord> entries_;
  std::list<Deleted> burials_;
  std::unordered_map<std::string, std::list<Deleted>::iterator> deleted_;
  Version floor_ = 0;
  std::uint64_t sequence_ = 0;
  /// The first of this incarnation's numbers.
  std::uint64_t base_ = 0;
};

} // namespace castor
