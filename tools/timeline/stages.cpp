#include "castor/tools/timeline/stages.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace castor::timeline {

namespace {

/// What comes later is laid over what was.
void take_over(Stage& into, Stage&& later) {
  into.begin = std::min(into.begin, later.begin);
  into.end = std::max(into.end, later.end);
  for (auto& [address, x] : later.changed) {
    auto [i, first] = into.changed.try_emplace(address, x);
    if (first)
      continue;
    x.is_new = i->second.is_new;
    x.since = i->second.since;
    i->second = std::move(x);
  }
}

} // namespace

void Stages::add(const ChangeEvent& event, const EntryPtr& entry) {
  if (is_news(event)) {
    if (stages_.empty() || event.time - last_news_ >= options_.gap)
      begin_burst(event.time, event.time - last_news_);
    last_news_ = std::max(last_news_, event.time);
  }
  links_.know(event.address);
  auto place = place_of(event, entry);
  current_.insert_or_assign(event.address.subarchitecture, place);
  first_changed_.try_emplace(event.address, place);
  place->begin = std::min(place->begin, event.time);
  place->end = std::max(place->end, event.time);

  auto [i, first] = place->changed.try_emplace(event.address);
  auto& x = i->second;
  if (first) {
    x.is_new = event.operation == Operation::add;
    x.since = event.time;
  }
  x.type = event.type_name();
  x.is_gone = event.operation == Operation::remove;
  x.version = event.version;
  x.writer = event.source;
  x.time = event.time;
  // What is read too late shows what is yet to come; that is better than nothing.
  if (x.is_gone)
    x.value = {};
  else if (entry && (!x.value.has_value() || entry->version == event.version))
    x.value = entry->value;
  if (stages_.size() > options_.most)
    merge_shortest();
}

bool Stages::is_news(const ChangeEvent& event) {
  auto& series = going_on_[{event.address.subarchitecture, event.type_name(), event.operation}];
  bool begins = series.last == Timestamp{0} || event.time - series.last >= options_.gap;
  if (begins)
    series.begin = event.time;
  series.last = std::max(series.last, event.time);
  return stages_.empty() || begins || event.time - series.begin < options_.patience * options_.gap;
}

void Stages::begin_burst(Timestamp time, Timestamp pause) {
  stages_.push_back({time, time, {}, pause});
  burst_ = std::prev(stages_.end());
  current_.clear();
  first_changed_.clear();
}

Stages::Place Stages::place_of(const ChangeEvent& event, const EntryPtr& entry) {
  auto is_after = [&](Place a, Place b) {
    for (auto i = b; ++i != stages_.end();)
      if (i == a)
        return true;
    return false;
  };
  auto& here = event.address.subarchitecture;
  auto result = current_.try_emplace(here, burst_).first->second;
  if (!entry)
    return result;
  for (auto& link : links_.of(event.address, contents_of(entry->value))) {
    auto i = first_changed_.find(link);
    if (link.subarchitecture == here || i == first_changed_.end() || is_after(result, i->second))
      continue;
    if (std::next(i->second) == stages_.end())
      stages_.push_back({event.time, event.time, {}, Timestamp{0}});
    result = std::next(i->second);
  }
  return result;
}

void Stages::merge_shortest() {
  auto cost = [](Place later) {
    return std::pair{later->pause, std::prev(later)->changed.size() + later->changed.size()};
  };
  auto least = std::next(stages_.begin());
  for (auto i = least; i != stages_.end(); ++i)
    if (cost(i) < cost(least))
      least = i;
  auto into = std::prev(least);
  take_over(*into, std::move(*least));
  auto move = [&](Place& x) {
    if (x == least)
      x = into;
  };
  for (auto& [name, x] : current_)
    move(x);
  for (auto& [address, x] : first_changed_)
    move(x);
  move(burst_);
  stages_.erase(least);
}

} // namespace castor::timeline
