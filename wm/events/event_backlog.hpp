#pragma once

#include "castor/wm/entries/address.hpp"
#include "castor/wm/events/change_notice.hpp"

#include <cstddef>
#include <cstdint>
#include <map>
#include <unordered_map>
#include <utility>
#include <vector>

namespace castor {

/// What one receiver has not been sent yet, oldest first.
///
/// Up to a bound it keeps every event as it came. Beyond it, it merges, until it has been emptied:
/// of each entry it keeps at most two events for each filter, a DELETE and an ADD or OVERWRITE
/// after it, and so no more than there are entries, however many events there were:
///
///     ADD, OVERWRITE         an ADD of the newer version
///     OVERWRITE, OVERWRITE   an OVERWRITE of the fields that either changed
///     OVERWRITE, DELETE      the DELETE
///     ADD, DELETE            nothing
///     DELETE, ADD, DELETE    the newer DELETE
///
/// What stands for several events is the newest of them in all other respects, has its place in the
/// order, and is marked `coalesced`. Whoever follows a filter that wants all changes of an entry
/// ends with the same picture of it as if every event had come.
class EventBacklog {
public:
  /// What goes out together: the notices of one write, or, where filters have seen different parts
  /// of an entry's story, the forms in which they get the same event.
  using Batch = std::vector<ChangeNotice>;

  explicit EventBacklog(std::size_t bound) : bound_(bound) {}

  /// Events of one subarchitecture come in their order. Those of one write stay together, unless
  /// the backlog merges.
  ///
  /// While it merges, it should be given the events that no filter wants, too: it then need not
  /// keep what single-minded filters (only ADD, only DELETE) want of entries that came and went.
  void push(Batch batch);
  void push(ChangeEventPtr event, std::vector<std::uint32_t> filters) {
    push(Batch{{std::move(event), std::move(filters)}});
  }

  /// What comes next; there must be something.
  Batch pop();

  /// The filter is withdrawn; its number may come again for another.
  void erase(std::uint32_t filter);

  /// How many notices wait.
  std::size_t size() const { return size_; }
  bool empty() const { return waiting_.empty(); }

  bool is_merging() const { return merging_; }

  /// How many of the events that some filter wanted have not come out and never will.
  std::uint64_t suppressed() const { return suppressed_; }

private:
  /// Counts what was pushed; 0 is never.
  using Arrival = std::uint64_t;

  /// What waits for one filter to hear of one entry.
  struct Pending {
    /// A DELETE, and an ADD or OVERWRITE.
    Arrival gone = 0;
    Arrival there = 0;
  };

  /// Of one entry, while events are merged.
  struct EntryHistory {
    /// When the entry was added, if that was seen.
    Arrival born = 0;
    std::map<std::uint32_t, Pending> by_filter;
  };
  using EntryHistories = std::unordered_map<Address, EntryHistory>;

  void begin_merging();
  void merge(const ChangeNotice& notice);
  void place(Arrival arrival, ChangeEventPtr event, std::uint32_t filter);
  /// The event waits no longer for this filter; null if none did.
  ChangeEventPtr take_back(Arrival& arrival, std::uint32_t filter);
  /// Forgets what is of no use any more.
  void trim(EntryHistories::iterator story);
  void rest_if_empty();

  std::size_t bound_;
  /// While events are merged, each batch is of a single event.
  std::map<Arrival, Batch> waiting_;
  std::size_t size_ = 0;
  bool merging_ = false;
  EntryHistories stories_;
  Arrival last_arrival_ = 0;
  Arrival last_taken_ = 0;
  std::uint64_t suppressed_ = 0;
};

} // namespace castor
