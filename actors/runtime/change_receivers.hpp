#pragma once

#include "castor/actors/component/operations.hpp"
#include "castor/wm/events/change_notice.hpp"
#include "castor/wm/filters/change_filter.hpp"
#include "castor/wm/filters/filter_index.hpp"

#include <cstddef>
#include <map>
#include <memory>
#include <vector>

namespace castor {

/// Receivers of a component's change events: its own callbacks, and listeners of the runtime, which
/// are called as soon as an event arrives.
class ChangeReceivers {
public:
  struct Receiver {
    ReceiverId id = 0;
    Priority priority = Priority::medium;
    ChangeCallback callback;
  };

  void add(ReceiverId id, ChangeCallback callback, Priority priority);
  /// False if there is none of that id.
  bool remove(ReceiverId id);
  bool contains(ReceiverId id) const { return receivers_.contains(id); }
  std::size_t size() const { return receivers_.size(); }

  /// Receivers of the filters, the highest priority first, and of one priority the oldest. They
  /// stay callable if they are removed meanwhile.
  SmallVector<std::shared_ptr<const Receiver>, 2> of(const FilterIds& filters) const;

  // -- in a system that broadcasts, where the component filters for itself

  /// The filter that matches every event, as which all of them arrive from now on.
  void set_broadcast(FilterId id) { broadcast_ = id; }
  bool is_broadcast() const { return broadcast_ != 0; }

  /// The filter of a callback. The subarchitecture must have been resolved; there must be no
  /// condition on the content, since events come without.
  void add_filter(FilterId id, const ChangeFilter& filter);

  /// Adds the filters that match the event to the notice; false if there are none.
  bool filter(ChangeNotice& notice);

  // -- of the runtime

  void add_listener(FilterId id, ChangeCallback f) { listeners_[id] = std::move(f); }

  /// Calls the listeners of a notice, and takes their filters from it; false if it has none.
  bool call_listeners(ChangeNotice& notice) const;

private:
  std::map<ReceiverId, std::shared_ptr<const Receiver>> receivers_;
  std::map<FilterId, ChangeCallback> listeners_;
  FilterId broadcast_ = 0;
  std::map<FilterId, ChangeFilter> filters_;
  FilterIndex index_;
  std::vector<FilterIndex::Key> matched_;
};

} // namespace castor
