#include "castor/actors/runtime/change_receivers.hpp"

#include <algorithm>
#include <utility>

namespace castor {

void ChangeReceivers::add(ReceiverId id, ChangeCallback callback, Priority priority) {
  receivers_[id] = std::make_shared<const Receiver>(Receiver{id, priority, std::move(callback)});
}

bool ChangeReceivers::remove(ReceiverId id) {
  if (auto filter = filters_.extract(id))
    index_.erase(id, filter.mapped());
  return receivers_.erase(id) > 0;
}

void ChangeReceivers::add_filter(FilterId id, const ChangeFilter& filter) {
  filters_[id] = filter;
  index_.insert(id, filter);
}

bool ChangeReceivers::filter(ChangeNotice& notice) {
  castor::erase(notice.filters, broadcast_);
  matched_.clear();
  index_.match(*notice.event, Value{}, matched_);
  for (auto key : matched_)
    notice.filters.push_back(static_cast<FilterId>(key));
  return !notice.filters.empty();
}

SmallVector<std::shared_ptr<const ChangeReceivers::Receiver>, 2>
ChangeReceivers::of(const FilterIds& filters) const {
  SmallVector<std::shared_ptr<const Receiver>, 2> result;
  for (auto id : filters)
    if (auto i = receivers_.find(id); i != receivers_.end())
      result.push_back(i->second);
  std::sort(result.begin(), result.end(), [](auto& a, auto& b) {
    return a->priority != b->priority ? a->priority > b->priority : a->id < b->id;
  });
  return result;
}

bool ChangeReceivers::call_listeners(ChangeNotice& notice) const {
  if (listeners_.empty())
    return false;
  auto called = erase_if(notice.filters, [&](FilterId id) {
    auto listener = listeners_.find(id);
    if (listener == listeners_.end())
      return false;
    listener->second(*notice.event);
    return true;
  });
  return called > 0;
}

} // namespace castor
