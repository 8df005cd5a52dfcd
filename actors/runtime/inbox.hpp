#pragma once

#include "castor/actors/component/subarchitecture_component.hpp"
#include "castor/actors/runtime/change_receivers.hpp"
#include "castor/actors/runtime/record.hpp"
#include "castor/wm/events/receipts.hpp"
#include "castor/wm/memory/working_memory_protocol.hpp"

#include <caf/mailbox_element.hpp>

#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <variant>

namespace castor {

/// Messages that wait for a component, oldest first. Change events that the component has taken, or
/// that were dropped, are acknowledged to the working memory in batches, which may then send
/// others.
class Inbox {
public:
  /// Work of the runtime on behalf of the component. `what` names it in reports of its failure.
  struct Task {
    std::string what;
    std::function<void()> run;
  };

  using Work = std::variant<ChangeNotice, caf::mailbox_element_ptr, Task>;

  Inbox(ChangeReceivers& receivers, ComponentCounters& counters, EventQueue mode,
        std::uint32_t limit);

  // Each returns the acknowledgement that is due because of it.

  std::optional<EventsTaken> put(ChangeNotice notice);
  /// A change event was taken out and is delivered.
  std::optional<EventsTaken> delivered() { return acknowledge(EventStream::component); }

  void put(caf::mailbox_element_ptr x) { waiting_.emplace_back(std::move(x)); }
  void put(Task x) { waiting_.emplace_back(std::move(x)); }

  bool is_empty() const { return waiting_.empty(); }
  Work take();
  void clear() { waiting_.clear(); }

  /// Switches change events for the component's own callbacks off and on.
  void receive_changes(bool on) { receiving_ = on; }

private:
  std::optional<EventsTaken> acknowledge(EventStream stream);

  ChangeReceivers& receivers_;
  ComponentCounters& counters_;
  const EventQueue mode_;
  bool receiving_ = true;
  std::deque<Work> waiting_;
  Receipts component_receipts_;
  Receipts runtime_receipts_{standard_queue_limit};
};

} // namespace castor
