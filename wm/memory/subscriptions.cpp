#include "castor/wm/memory/subscriptions.hpp"

#include "castor/wm/memory/receiver_keys.hpp"

#include <algorithm>

namespace castor {

using namespace receiver_keys;

namespace {

/// The batch of a subscriber, which is added if there is none.
Subscriptions::Batch& batch_of(Subscriptions::Number number, Subscriptions::Notices& notices) {
  // The events of a single change are collected in order.
  if (notices.empty() || notices.back().first < number)
    return notices.emplace_back(number, Subscriptions::Batch{}).second;
  auto i =
    std::ranges::lower_bound(notices, number, {}, &Subscriptions::Notices::value_type::first);
  if (i->first != number)
    i = notices.emplace(i, number, Subscriptions::Batch{});
  return i->second;
}

} // namespace

Subscriptions::Number Subscriptions::add(std::string component, std::uint32_t queue_limit) {
  auto number = ++last_number_;
  subscribers_.emplace(number, Subscriber{std::move(component), EventFlow{queue_limit}});
  return number;
}

std::vector<Subscriptions::WithdrawnInterest> Subscriptions::remove(Number number) {
  auto& [component, flow, filters, usage] = subscribers_.at(number);
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
  notices.reserve(notices.size() + keys.size());
  for_each_receiver(keys, [&](Number number, FilterIds ids) {
    batch_of(number, notices).push_back({event, std::move(ids)});
  });
  // A backlog that merges is to know of the others, too: of all that came here.
  for (auto number : merging_)
    if (auto& list = batch_of(number, notices); list.empty() || list.back().event != event)
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

void Subscriptions::count(Subscriber& subscriber, const Batch& batch, UsageLog& usage) {
  for (auto& [event, filters] : batch) {
    if (filters.empty())
      continue;
    ++counters_.matched;
    if (subscriber.component.empty())
      continue;
    auto& subarchitecture = event->address.subarchitecture;
    auto& last = subscriber.usage;
    if (!last || last->type != event->type_name() || last->subarchitecture != subarchitecture)
      last = &usage.usage(subscriber.component, subarchitecture, event->type_name());
    ++last->events;
  }
}

void Subscriptions::update_merging(Number number, const Subscriber& subscriber) {
  if (subscriber.flow.backlog().is_merging())
    merging_.insert(number);
  else
    merging_.erase(number);
}

} // namespace castor
