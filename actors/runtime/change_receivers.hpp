#pragma once

#include "castor/actors/component/operations.hpp"
#include "castor/wm/events/change_notice.hpp"
#include "castor/wm/filters/change_filter.hpp"

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
  bool remove(ReceiverId id) { return receivers_.erase(id) > 0; }
  bool contains(ReceiverId id) const { return receivers_.contains(id); }
  std::size_t size() const { return receivers_.size(); }

  /// Receivers of the filters, the highest priority first, and of one priority the oldest. They
  /// stay callable if they are removed meanwhile.
  std::vector<std::shared_ptr<const Receiver>> of(const std::vector<FilterId>& filters) const;

  void add_listener(FilterId id, ChangeCallback f) { listeners_[id] = std::move(f); }

  /// Calls the listeners of a notice, and takes their filters from it; false if it has none.
  bool call_listeners(ChangeNotice& notice) const;

private:
  std::map<ReceiverId, std::shared_ptr<const Receiver>> receivers_;
  std::map<FilterId, ChangeCallback> listeners_;
};

} // namespace castor
