#include "castor/wm/events/event_backlog.hpp"

#include <algorithm>
#include <memory>

namespace castor {

namespace {

/// The event that stands for both; `earlier` may be null.
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

/// Whether two events that stand for the same newest one say the same.
bool say_the_same(const ChangeEvent& a, const ChangeEvent& b) {
  return a.operation == b.operation && a.changed == b.changed && a.coalesced == b.coalesced;
}

} // namespace

void EventBacklog::push(Batch batch) {
  if (merging_) {
    for (auto& notice : batch)
      merge(notice);
    rest_if_empty();
    return;
  }
  std::erase_if(batch, [](auto& notice) { return notice.filters.empty(); });
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
    auto story = stories_.find(event->address);
    if (story == stories_.end())
      continue;
    for (auto filter : filters) {
      auto& [gone, there] = story->second.by_filter[filter];
      (event->operation == Operation::remove ? gone : there) = 0;
    }
    trim(story);
  }
  rest_if_empty();
  return std::move(batch);
}

void EventBacklog::erase(std::uint32_t filter) {
  for (auto i = waiting_.begin(); i != waiting_.end();) {
    auto& batch = i->second;
    auto notices = batch.size();
    std::erase_if(batch, [&](auto& notice) {
      std::erase(notice.filters, filter);
      return notice.filters.empty();
    });
    size_ -= notices - batch.size();
    // The forms of one event count once.
    suppressed_ += merging_ ? batch.empty() : notices - batch.size();
    i = batch.empty() ? waiting_.erase(i) : std::next(i);
  }
  for (auto i = stories_.begin(); i != stories_.end();) {
    auto story = i++;
    story->second.by_filter.erase(filter);
    trim(story);
  }
  rest_if_empty();
}

void EventBacklog::begin_merging() {
  merging_ = true;
  size_ = 0;
  for (auto& [arrival, batch] : std::exchange(waiting_, {}))
    for (auto& notice : batch)
      merge(notice);
  rest_if_empty();
}

void EventBacklog::merge(const ChangeNotice& notice) {
  auto& event = notice.event;
  auto arrival = ++last_arrival_;
  auto i = stories_.try_emplace(event->address).first;
  auto& story = i->second;
  bool is_end = event->operation == Operation::remove;
  if (event->operation == Operation::add)
    story.born = arrival;
  for (auto filter : notice.filters) {
    auto& [gone, there] = story.by_filter[filter];
    auto earlier = take_back(there, filter);
    if (!is_end) {
      place(arrival, merged(earlier, event), filter);
      there = arrival;
      continue;
    }
    bool unheard_of = story.born > last_taken_ || (earlier && earlier->operation == Operation::add);
    if (auto earlier_end = take_back(gone, filter))
      earlier = earlier_end;
    else if (unheard_of)
      continue;
    place(arrival, merged(earlier, event), filter);
    gone = arrival;
  }
  if (is_end) {
    // Who did not ask for the end of entries need not hear of one that has ended.
    for (auto& [filter, pending] : story.by_filter)
      take_back(pending.there, filter);
    story.born = 0;
  }
  if (!notice.filters.empty() && waiting_.count(arrival) == 0)
    ++suppressed_;
  trim(i);
}

void EventBacklog::place(Arrival arrival, ChangeEventPtr event, std::uint32_t filter) {
  auto& forms = waiting_.try_emplace(waiting_.end(), arrival)->second;
  auto same = std::find_if(forms.begin(), forms.end(),
                           [&](auto& x) { return say_the_same(*x.event, *event); });
  if (same != forms.end()) {
    same->filters.push_back(filter);
    return;
  }
  forms.push_back({std::move(event), {filter}});
  ++size_;
}

ChangeEventPtr EventBacklog::take_back(Arrival& arrival, std::uint32_t filter) {
  if (arrival == 0)
    return nullptr;
  auto i = waiting_.find(std::exchange(arrival, 0));
  auto& forms = i->second;
  auto form = std::find_if(forms.begin(), forms.end(), [&](auto& x) {
    return std::find(x.filters.begin(), x.filters.end(), filter) != x.filters.end();
  });
  auto event = form->event;
  std::erase(form->filters, filter);
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

void EventBacklog::trim(EntryHistories::iterator story) {
  auto& [born, by_filter] = story->second;
  std::erase_if(by_filter, [](auto& x) { return x.second.gone == 0 && x.second.there == 0; });
  if (by_filter.empty() && born <= last_taken_)
    stories_.erase(story);
}

void EventBacklog::rest_if_empty() {
  if (!waiting_.empty())
    return;
  merging_ = false;
  stories_.clear();
}

} // namespace castor
