#pragma once

#include "castor/base/small_vector.hpp"
#include "castor/wm/entries/address.hpp"
#include "castor/wm/events/change_notice.hpp"

#include <cstddef>
#include <cstdint>
#include <map>
#include <unordered_map>
#include <utility>

namespace castor {

/// Events not yet sent to one receiver, oldest first.
///
/// Up to a bound it keeps every event. Beyond that it merges events until it is empty: it keeps at
/// most two events per entry and filter, a DELETE and a later ADD or OVERWRITE, so that its size is
/// bounded by the number of entries:
///
///     ADD, OVERWRITE         an ADD of the newer version
///     OVERWRITE, OVERWRITE   an OVERWRITE of the fields that either changed
///     OVERWRITE, DELETE      the DELETE
///     ADD, DELETE            nothing
///     DELETE, ADD, DELETE    the newer DELETE
///
/// A merged event is otherwise a copy of the newest, has its place in the order, and is marked
/// `coalesced`. With a filter for all changes of an entry, a receiver arrives at the same state of
/// the entry as with every single event.
class EventBacklog {
public:
  /// Notices that are sent together: those of one write, or the variants of one merged event for
  /// filters that have received different earlier events of its entry.
  using Batch = SmallVector<ChangeNotice, 1>;

  explicit EventBacklog(std::size_t bound) : bound_(bound) {}

  /// To be called in order for the events of one subarchitecture. Those of one write stay together,
  /// unless the backlog merges.
  ///
  /// While the backlog merges, events without filters should be pushed, too: it can then drop
  /// pending events of entries that were added and deleted, also for filters for one operation
  /// (only ADD, only DELETE).
  void push(Batch batch);
  void push(ChangeEventPtr event, FilterIds filters) {
    push(Batch{{std::move(event), std::move(filters)}});
  }

  /// Removes and returns the next batch. \pre not empty
  Batch pop();

  /// Removes a withdrawn filter; its number may be used again for another.
  void erase(std::uint32_t filter);

  /// Number of waiting notices.
  std::size_t size() const { return size_; }
  bool empty() const { return waiting_.empty(); }

  bool is_merging() const { return merging_; }

  /// Number of events that matched a filter and will never be returned, because they were merged or
  /// their filter was withdrawn.
  std::uint64_t suppressed() const { return suppressed_; }

private:
  /// Number of a pushed event, from 1; 0 for none.
  using Arrival = std::uint64_t;

  /// Waiting events of one entry for one filter.
  struct Pending {
    /// Arrival of a DELETE, and of an ADD or OVERWRITE.
    Arrival removal = 0;
    Arrival update = 0;
  };

  /// History of one entry, while events are merged.
  struct EntryHistory {
    /// Arrival of the entry's ADD, if it was pushed.
    Arrival added = 0;
    std::map<std::uint32_t, Pending> by_filter;
  };
  using EntryHistories = std::unordered_map<Address, EntryHistory>;

  void begin_merging();
  void merge(const ChangeNotice& notice);
  void place(Arrival arrival, ChangeEventPtr event, std::uint32_t filter);
  /// Removes and returns the event that waits for this filter; null if there is none.
  ChangeEventPtr withdraw(Arrival& arrival, std::uint32_t filter);
  /// Removes the parts of a history that are no longer needed.
  void trim(EntryHistories::iterator history);
  void stop_merging_if_empty();

  std::size_t bound_;
  /// While events are merged, each batch has variants of a single event.
  std::map<Arrival, Batch> waiting_;
  std::size_t size_ = 0;
  bool merging_ = false;
  EntryHistories histories_;
  Arrival last_arrival_ = 0;
  Arrival last_taken_ = 0;
  std::uint64_t suppressed_ = 0;
};

} // namespace castor
