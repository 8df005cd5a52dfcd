#pragma once

#include "castor/wm/entries/entry.hpp"

#include <cstddef>
#include <cstdint>

namespace castor {

/// An entry of a working memory, and what the working memory knows of it.
struct EntrySlot {
  EntryPtr entry;
  /// Number of its last write. One word with the next two: there may be millions of slots.
  std::uint64_t written : 62 = 0;
  /// Whether it may end by itself.
  bool may_end : 1 = false;
  /// Whether somebody has a lease that keeps others from reading it.
  bool is_excluded : 1 = false;
  /// Neighbours in the Recency that it is in, or null.
  EntrySlot* newer = nullptr;
  EntrySlot* older = nullptr;

  void set_written(std::uint64_t number) { written = number & (~std::uint64_t{0} >> 2); }
};

/// Slots in order of their last writes, the newest first. They belong to somebody else, and have to
/// stay where they are while they are in it.
class Recency {
public:
  /// Null if there is none.
  const EntrySlot* newest() const { return newest_; }
  std::size_t size() const { return size_; }

  /// The slot has just been written, and is in no Recency.
  void add(EntrySlot& x) {
    x.newer = nullptr;
    x.older = newest_;
    if (newest_)
      newest_->newer = &x;
    newest_ = &x;
    ++size_;
  }

  /// The slot is in here.
  void remove(EntrySlot& x) {
    (x.newer ? x.newer->older : newest_) = x.older;
    if (x.older)
      x.older->newer = x.newer;
    x.newer = x.older = nullptr;
    --size_;
  }

private:
  EntrySlot* newest_ = nullptr;
  std::size_t size_ = 0;
};

} // namespace castor
