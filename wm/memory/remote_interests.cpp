#include "castor/wm/memory/remote_interests.hpp"

namespace castor {

InterestId RemoteInterests::add(const ChangeFilter& filter, FilterIndex::Key subscriber) {
  auto& interest = by_filter_[filter];
  if (interest.subscribers.empty()) {
    interest.id = ++last_;
    by_id_[interest.id] = &interest;
  }
  interest.subscribers.push_back(subscriber);
  return interest.id;
}

std::optional<InterestId> RemoteInterests::remove(const ChangeFilter& filter,
                                                  FilterIndex::Key subscriber) {
  auto i = by_filter_.find(filter);
  if (i == by_filter_.end())
    return std::nullopt;
  auto& [id, subscribers] = i->second;
  std::erase(subscribers, subscriber);
  if (!subscribers.empty())
    return std::nullopt;
  auto result = id;
  by_id_.erase(result);
  by_filter_.erase(i);
  return result;
}

void RemoteInterests::append_subscribers(InterestId id, std::vector<FilterIndex::Key>& out) const {
  if (auto i = by_id_.find(id); i != by_id_.end())
    out.insert(out.end(), i->second->subscribers.begin(), i->second->subscribers.end());
}

} // namespace castor
