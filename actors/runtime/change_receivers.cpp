#include "castor/actors/runtime/change_receivers.hpp"

#include <algorithm>
#include <utility>

namespace castor {

void ChangeReceivers::add(ReceiverId id, ChangeCallback callback, Priority priority) {
  receivers_[id] = std::make_shared<const Receiver>(Receiver{id, priority, std::move(callback)});
}

std::vector<std::shared_ptr<const ChangeReceivers::Receiver>>
ChangeReceivers::of(const std::vector<FilterId>& filters) const {
  std::vector<std::shared_ptr<const Receiver>> result;
  for (auto id : filters)
    if (auto i = receivers_.find(id); i != receivers_.end())
      result.push_back(i->second);
  std::sort(result.begin(), result.end(), [](auto& a, auto& b) {
    return a->priority != b->priority ? a->priority > b->priority : a->id < b->id;
  });
  return result;
}

bool ChangeReceivers::call_listeners(ChangeNotice& notice) const {
  auto called = std::erase_if(notice.filters, [&](FilterId id) {
    auto listener = listeners_.find(id);
    if (listener == listeners_.end())
      return false;
    listener->second(*notice.event);
    return true;
  });
  return called > 0;
}

} // namespace castor
