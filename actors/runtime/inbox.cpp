#include "castor/actors/runtime/inbox.hpp"

#include <algorithm>

namespace castor {

Inbox::Inbox(ChangeReceivers& receivers, ComponentCounters& counters, EventQueue mode,
             std::uint32_t limit)
  : receivers_(receivers), counters_(counters), mode_(mode), component_receipts_(limit) {}

std::optional<EventsTaken> Inbox::put(ChangeNotice notice) {
  if (receivers_.call_listeners(notice))
    return acknowledge(EventStream::runtime);
  if (!receiving_)
    return acknowledge(EventStream::component);
  ++counters_.events_received;
  if (receivers_.is_broadcast() && !receivers_.filter(notice)) {
    ++counters_.events_rejected;
    return acknowledge(EventStream::component);
  }
  std::optional<EventsTaken> result;
  if (mode_ == EventQueue::newest) {
    auto older = std::find_if(waiting_.begin(), waiting_.end(),
                              [](auto& x) { return std::holds_alternative<ChangeNotice>(x); });
    if (older != waiting_.end()) {
      ++counters_.events_discarded;
      waiting_.erase(older);
      result = acknowledge(EventStream::component);
    }
  }
  waiting_.emplace_back(std::move(notice));
  return result;
}

Inbox::Work Inbox::take() {
  auto result = std::move(waiting_.front());
  waiting_.pop_front();
  return result;
}

std::optional<EventsTaken> Inbox::acknowledge(EventStream stream) {
  auto& receipts = stream == EventStream::runtime ? runtime_receipts_ : component_receipts_;
  if (auto count = receipts.take())
    return EventsTaken{stream, count};
  return std::nullopt;
}

} // namespace castor
