#include "castor/wm/memory/subscriptions.hpp"

#include "castor/wm/memory/receiver_keys.hpp"

namespace castor {

using namespace receiver_keys;

Subscriptions::Number Subscriptions::add(std::string component, std::uint32_t queue_limit) {
  auto number = ++last_number_;
  subscribers_[number] = {std::move(component), EventFlow{queue_limit}, {}};
  return number;
}

std::vector<Subscriptions::WithdrawnInterest> Subscriptions::remove(Number number) {
  auto& [component, flow, filters] = subscribers_.at(number);
  counters_.suppressed += flow.backlog().suppressed();
  // Nobody waits for what it holds, so its filters need not be looked for there.
  flow = EventFlow{};
  std::vector<WithdrawnInterest> result;
  while (!filters.empty())
    if (auto withdrawn = unsubscribe(number, filters.begin()->first))
      result.push_back(*std::move(withdrawn));
  merging_.erase(number);
  subscribers_.erase(number);
  return result;
}

std::optional<InterestId> Subscriptions::subscribe(Number number, FilterId id,
                                                   const ChangeFilter& filter) {
  auto key = key_of(number, id);
  filters_.insert(key, filter);
  subscribers_.at(number).filters[id] = filter;
  if (*filter.subarchitecture == subarchitecture_)
    return std::nullopt;
  return interests_.add(filter, key);
}

std::optional<Subscriptions::WithdrawnInterest> Subscriptions::unsubscribe(Number number,
                                                                           FilterId id) {
  auto& subscriber = subscribers_.at(number);
  auto filter = subscriber.filters.extract(id);
  if (!filter)
    return std::nullopt;
  auto key = key_of(number, id);
  filters_.erase(key, filter.mapped());
  subscriber.flow.erase(id);
  update_merging(number, subscriber);
  auto interest = interests_.remove(filter.mapped(), key);
  if (!interest)
    return std::nullopt;
  return WithdrawnInterest{*interest, std::move(filter.mapped())};
}

const std::vector<FilterIndex::Key>& Subscriptions::match(const ChangeEvent& event,
                                                          const Value& content) {
  matched_.clear();
  if (!is_ignored(event))
    filters_.match(event, content, matched_);
  sort_unique(matched_);
  return matched_;
}

void Subscriptions::collect(const ChangeEventPtr& event, const std::vector<FilterIndex::Key>& keys,
                            Notices& notices) const {
  for_each_receiver(keys, [&](Number number, std::vector<FilterId> ids) {
    notices[number].push_back({event, std::move(ids)});
  });
  // A backlog that merges is to know of the others, too: of all that came here.
  for (auto number : merging_)
    if (auto& list = notices[number]; list.empty() || list.back().event != event)
      list.push_back({event, {}});
}

Subscriptions::Notices Subscriptions::receive(const ChangeNotices& events) {
  Notices result;
  for (auto& [event, interests] : events.notices) {
    if (is_ignored(*event))
      continue;
    matched_.clear();
    for (auto id : interests)
      interests_.append_subscribers(id, matched_);
    sort_unique(matched_);
    collect(event, matched_, result);
  }
  return result;
}

Subscriptions::Counters Subscriptions::counters() const {
  auto result = counters_;
  for (auto& [number, subscriber] : subscribers_) {
    result.backlog += subscriber.flow.backlog().size();
    result.suppressed += subscriber.flow.backlog().suppressed();
  }
  return result;
}

void Subscriptions::count(const Subscriber& subscriber, const Batch& batch, UsageLog& usage) {
  for (auto& [event, filters] : batch) {
    if (filters.empty())
      continue;
    ++counters_.matched;
    if (!subscriber.component.empty())
      usage.record(subscriber.component, event->address.subarchitecture, event->type_name(),
                   &Usage::events);
  }
}

void Subscriptions::update_merging(Number number, const Subscriber& subscriber) {
  if (subscriber.flow.backlog().is_merging())
    merging_.insert(number);
  else
    merging_.erase(number);
}

} // namespace castor
