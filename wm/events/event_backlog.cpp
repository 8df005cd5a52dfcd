#include "castor/wm/events/event_backlog.hpp"

#include <algorithm>
#include <memory>

namespace castor {

namespace {

/// The event that replaces both; `earlier` may be null.
ChangeEventPtr merged(const ChangeEventPtr& earlier, const ChangeEventPtr& event) {
  if (!earlier)
    return event;
  auto result = std::make_shared<ChangeEvent>(*event);
  result->coalesced = true;
  if (event->operation == Operation::overwrite) {
    if (earlier->operation == Operation::add) {
      result->operation = Operation::add;
      result->changed = 0;
    } else if (earlier->type->hash == event->type->hash) {
      result->changed |= earlier->changed;
    }
  }
  return result;
}

/// Whether two variants of the same newest event are equal.
bool have_same_content(const ChangeEvent& a, const ChangeEvent& b) {
  return a.operation == b.operation && a.changed == b.changed && a.coalesced == b.coalesced;
}

} // namespace

void EventBacklog::push(Batch batch) {
  if (merging_) {
    for (auto& notice : batch)
      merge(notice);
    stop_merging_if_empty();
    return;
  }
  erase_if(batch, [](auto& notice) { return notice.filters.empty(); });
  if (batch.empty())
    return;
  size_ += batch.size();
  waiting_.emplace_hint(waiting_.end(), ++last_arrival_, std::move(batch));
  if (size_ > bound_)
    begin_merging();
}

EventBacklog::Batch EventBacklog::pop() {
  auto first = waiting_.extract(waiting_.begin());
  auto& batch = first.mapped();
  last_taken_ = first.key();
  size_ -= batch.size();
  for (auto& [event, filters] : batch) {
    auto history = histories_.find(event->address);
    if (history == histories_.end())
      continue;
    for (auto filter : filters) {
      auto& [removal, update] = history->second.by_filter[filter];
      (event->operation == Operation::remove ? removal : update) = 0;
    }
    trim(history);
  }
  stop_merging_if_empty();
  return std::move(batch);
}

void EventBacklog::erase(std::uint32_t filter) {
  for (auto i = waiting_.begin(); i != waiting_.end();) {
    auto& batch = i->second;
    auto notices = batch.size();
    erase_if(batch, [&](auto& notice) {
      castor::erase(notice.filters, filter);
      return notice.filters.empty();
    });
    size_ -= notices - batch.size();
    // Variants of one event count once.
    suppressed_ += merging_ ? batch.empty() : notices - batch.size();
    i = batch.empty() ? waiting_.erase(i) : std::next(i);
  }
  for (auto i = histories_.begin(); i != histories_.end();) {
    auto history = i++;
    history->second.by_filter.erase(filter);
    trim(history);
  }
  stop_merging_if_empty();
}

void EventBacklog::begin_merging() {
  merging_ = true;
  size_ = 0;
  for (auto& [arrival, batch] : std::exchange(waiting_, {}))
    for (auto& notice : batch)
      merge(notice);
  stop_merging_if_empty();
}

void EventBacklog::merge(const ChangeNotice& notice) {
  auto& event = notice.event;
  auto arrival = ++last_arrival_;
  auto i = histories_.try_emplace(event->address).first;
  auto& history = i->second;
  bool is_removal = event->operation == Operation::remove;
  if (event->operation == Operation::add)
    history.added = arrival;
  for (auto filter : notice.filters) {
    auto& [removal, update] = history.by_filter[filter];
    auto earlier = withdraw(update, filter);
    if (!is_removal) {
      place(arrival, merged(earlier, event), filter);
      update = arrival;
      continue;
    }
    bool is_add_unsent =
      history.added > last_taken_ || (earlier && earlier->operation == Operation::add);
    if (auto earlier_removal = withdraw(removal, filter))
      earlier = earlier_removal;
    else if (is_add_unsent)
      continue;
    place(arrival, merged(earlier, event), filter);
    removal = arrival;
  }
  if (is_removal) {
    // Filters that do not want deletions need no events of a deleted entry.
    for (auto& [filter, pending] : history.by_filter)
      withdraw(pending.update, filter);
    history.added = 0;
  }
  if (!notice.filters.empty() && waiting_.count(arrival) == 0)
    ++suppressed_;
  trim(i);
}

void EventBacklog::place(Arrival arrival, ChangeEventPtr event, std::uint32_t filter) {
  auto& forms = waiting_.try_emplace(waiting_.end(), arrival)->second;
  auto same = std::find_if(forms.begin(), forms.end(),
                           [&](auto& x) { return have_same_content(*x.event, *event); });
  if (same != forms.end()) {
    same->filters.push_back(filter);
    return;
  }
  forms.push_back({std::move(event), {filter}});
  ++size_;
}

ChangeEventPtr EventBacklog::withdraw(Arrival& arrival, std::uint32_t filter) {
  if (arrival == 0)
    return nullptr;
  auto i = waiting_.find(std::exchange(arrival, 0));
  auto& forms = i->second;
  auto form = std::find_if(forms.begin(), forms.end(), [&](auto& x) {
    return std::find(x.filters.begin(), x.filters.end(), filter) != x.filters.end();
  });
  auto event = form->event;
  castor::erase(form->filters, filter);
  if (form->filters.empty()) {
    forms.erase(form);
    --size_;
  }
  if (forms.empty()) {
    waiting_.erase(i);
    ++suppressed_;
  }
  return event;
}

void EventBacklog::trim(EntryHistories::iterator history) {
  auto& [added, by_filter] = history->second;
  std::erase_if(by_filter, [](auto& x) { return x.second.removal == 0 && x.second.update == 0; });
  if (by_filter.empty() && added <= last_taken_)
    histories_.erase(history);
}

void EventBacklog::stop_merging_if_empty() {
  if (!waiting_.empty())
    return;
  merging_ = false;
  histories_.clear();
}

} // namespace castor
