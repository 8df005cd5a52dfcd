#pragma once

#include "castor/wm/entries/entry.hpp"
#include "castor/wm/store/read_counts.hpp"
#include "castor/wm/store/recency.hpp"
#include "castor/wm/store/spin_lock.hpp"

#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <string>
#include <string_view>
#include <unordered_set>
#include <utility>

namespace castor {

/// The entries of a working memory by id. It belongs to the thread that runs the working memory;
/// other threads of the process read entries without a message to it, where the answer would be the
/// same.
///
/// Reads are linearizable with the operations that the working memory answers: a change is in the
/// table before it is answered or sent to anybody, an entry is excluded before a lease of level ODR
/// is granted, and the changes of an atomic write are seen together or not at all. Where time has
/// ended a lease and the working memory has not noticed yet, it has to be asked. Each part of the
/// table has a lock, which readers and the owner hold for a few instructions.
class EntryTable {
public:
  using Time = std::chrono::steady_clock::time_point;

  using Slot = EntrySlot;

  EntryTable() = default;
  EntryTable(const EntryTable&) = delete;
  EntryTable& operator=(const EntryTable&) = delete;

  // -- for other threads

  /// The entry, if it is there and its working memory would tell everybody so at once; otherwise
  /// null, and the working memory has to be asked. `now` tells the time of the clock of leases.
  template <class F>
  EntryPtr read(const std::string& id, F&& now) const {
    auto due = due_.load(std::memory_order_acquire);
    if (due != never && Time{now()}.time_since_epoch().count() >= due)
      return nullptr;
    return read_in_time(id);
  }

  /// Counts of the entries that were read in this way; for any thread.
  ReadCounts& counts() const { return counts_; }

  /// Entries that have been deleted in this process so far, in all tables; for any thread.
  static std::uint64_t deletions() { return deletions_.load(std::memory_order_relaxed); }

  /// Nobody reads here any more; for any thread. The owner may still be at work.
  void close() { is_closed_.store(true, std::memory_order_release); }

  // -- for the owner

  /// Null if there is none.
  const Slot* find(const std::string& id) const {
    auto& slots = part_of(id).slots;
    auto i = slots.find(std::string_view{id});
    return i == slots.end() ? nullptr : &*i;
  }

  std::size_t size() const { return size_; }

  /// The entry's id must be new. Returns its slot, which stays where it is until it is erased.
  Slot& insert(EntryPtr entry, std::uint64_t written, bool may_end = false);

  /// Calls `f` with the slot of an id that must be there; what it puts there must have the id, too.
  template <class F>
  void change(const std::string& id, F&& f) {
    auto& part = part_of(id);
    std::lock_guard guard{part.lock};
    f(slot_in(part, id));
  }

  /// The id must be there.
  void erase(const std::string& id);

  /// The next lease or wait ends at that time, unless something happens before.
  void set_due(Time x) { due_.store(x.time_since_epoch().count(), std::memory_order_release); }

  /// Keeps other threads from reading while several changes are made that belong together.
  void begin_atomic() { is_held_.store(true, std::memory_order_release); }
  void end_atomic() { is_held_.store(false, std::memory_order_release); }

  /// Closes the table and frees the entries.
  void clear();

private:
  /// Slots are found by the ids of their entries, of which there is so only one copy.
  struct IdHash {
    using is_transparent = void;

    // Not noexcept, so that the table keeps the hash and need not look at the entry for it.
    std::size_t operator()(std::string_view id) const { return std::hash<std::string_view>{}(id); }
    std::size_t operator()(const Slot& x) const { return operator()(x.entry->address.id); }
  };

  struct SameId {
    using is_transparent = void;

    bool operator()(const Slot& a, const Slot& b) const {
      return a.entry->address.id == b.entry->address.id;
    }
    bool operator()(std::string_view id, const Slot& x) const { return id == x.entry->address.id; }
    bool operator()(const Slot& x, std::string_view id) const { return id == x.entry->address.id; }
  };

  using Slots = std::unordered_set<Slot, IdHash, SameId>;

  struct alignas(64) Part {
    mutable SpinLock lock;
    Slots slots;
  };
  static constexpr std::size_t part_count = 64;
  static constexpr auto never = Time::max().time_since_epoch().count();

  EntryPtr read_in_time(const std::string& id) const;

  /// A set has its elements const, since it does not know that the id stays.
  static Slot& slot_in(Part& part, std::string_view id) {
    return const_cast<Slot&>(*part.slots.find(id));
  }

  const Part& part_of(std::string_view id) const {
    // Not the low bits, by which each part orders its own ids.
    return parts_[(std::hash<std::string_view>{}(id) >> 48) % part_count];
  }
  Part& part_of(std::string_view id) { return const_cast<Part&>(std::as_const(*this).part_of(id)); }

  static inline std::atomic<std::uint64_t> deletions_{0};

  std::array<Part, part_count> parts_;
  std::atomic<bool> is_closed_{false};
  std::atomic<bool> is_held_{false};
  /// As ticks of the clock; `never` if there is none.
  std::atomic<Time::rep> due_{never};
  std::size_t size_ = 0;
  mutable ReadCounts counts_;
};

} // namespace castor
