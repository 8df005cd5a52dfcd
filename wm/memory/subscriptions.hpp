#pragma once

#include "castor/wm/events/event_flow.hpp"
#include "castor/wm/filters/filter_index.hpp"
#include "castor/wm/memory/remote_interests.hpp"
#include "castor/wm/memory/working_memory_messages.hpp"
#include "castor/wm/store/usage_log.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace castor {

/// The filters registered at one working memory, and the events queued for their subscribers.
/// Sending is left to the caller, by a function `send(Number, Batch)`.
class Subscriptions {
public:
  /// Number of a subscriber, which is one stream of events; never used twice.
  using Number = std::uint32_t;
  using Batch = EventFlow::Batch;

  /// Events of one write, by subscriber, in the order of their numbers.
  using Notices = std::vector<std::pair<Number, Batch>>;

  /// An interest in the other subarchitectures that has no subscriber any more.
  struct WithdrawnInterest {
    InterestId id = 0;
    ChangeFilter filter;
  };

  struct Counters {
    /// As in WorkingMemoryStatus.
    std::uint64_t matched = 0;
    std::uint64_t delivered = 0;
    std::uint64_t coalesced = 0;
    std::uint64_t suppressed = 0;
    std::uint64_t backlog = 0;
  };

  /// Changes in the ignored subarchitectures match no filter. Interests are numbered from
  /// `last_interest` + 1.
  Subscriptions(std::string subarchitecture, std::set<std::string> ignored,
                InterestId last_interest)
    : subarchitecture_(std::move(subarchitecture)), ignored_(std::move(ignored)),
      interests_(last_interest) {}

  // -- subscribers

  /// Adds a subscriber. `component` is empty for one that is not a component; its events are not
  /// counted in the usage log.
  Number add(std::string component, std::uint32_t queue_limit);

  /// Removes a subscriber and its queued events.
  std::vector<WithdrawnInterest> remove(Number number);

  /// Registers a filter, whose subarchitecture has to be resolved. An earlier filter of that id has
  /// to be withdrawn before. Returns the interest to announce to the other working memories;
  /// nothing for a filter on the own subarchitecture.
  std::optional<InterestId> subscribe(Number number, FilterId id, const ChangeFilter& filter);

  /// Withdraws a filter, if it is registered.
  std::optional<WithdrawnInterest> unsubscribe(Number number, FilterId id);

  /// Calls `f` with the filter and the number of each interest in the other working memories.
  template <class F>
  void for_each_interest(F&& f) const {
    interests_.for_each(std::forward<F>(f));
  }

  // -- events

  bool wants_changed_fields(const ChangeEvent& event) const {
    return filters_.wants_changed_fields(event);
  }

  /// The keys (receiver_keys.hpp) of the filters that match the event, in order; valid until the
  /// next call.
  const std::vector<FilterIndex::Key>& match(const ChangeEvent& event, const Value& content);

  /// Adds an event to `notices`.
  void collect(const ChangeEventPtr& event, const std::vector<FilterIndex::Key>& keys,
               Notices& notices) const;

  /// The events of a write in another working memory, by subscriber.
  Notices receive(const ChangeNotices& events);

  template <class F>
  void push(Notices notices, UsageLog& usage, F&& send) {
    for (auto& [number, batch] : notices) {
      auto& subscriber = subscribers_.at(number);
      count(subscriber, batch, usage);
      if (auto now = subscriber.flow.push(std::move(batch))) {
        counters_.delivered += now->size();
        send(number, *std::move(now));
      } else {
        update_merging(number, subscriber);
      }
    }
  }

  /// The subscriber has taken `count` events.
  template <class F>
  void acknowledge(Number number, std::uint64_t count, F&& send) {
    auto& subscriber = subscribers_.at(number);
    subscriber.flow.acknowledge(count);
    while (auto batch = subscriber.flow.next()) {
      for (auto& notice : *batch)
        counters_.coalesced += notice.event->coalesced;
      counters_.delivered += batch->size();
      send(number, *std::move(batch));
    }
    update_merging(number, subscriber);
  }

  /// Number of filters.
  std::size_t size() const { return filters_.size(); }
  Counters counters() const;

private:
  struct Subscriber {
    std::string component;
    EventFlow flow;
    std::unordered_map<FilterId, ChangeFilter> filters = {};
    /// Where its last event was counted, which mostly is where the next one will be. Null at first.
    Usage* usage = nullptr;
  };

  bool is_ignored(const ChangeEvent& event) const {
    return ignored_.count(event.address.subarchitecture) > 0;
  }
  void count(Subscriber& subscriber, const Batch& batch, UsageLog& usage);
  void update_merging(Number number, const Subscriber& subscriber);

  std::string subarchitecture_;
  std::set<std::string> ignored_;
  /// Keys: the subscriber's number above its filter's id.
  FilterIndex filters_;
  std::unordered_map<Number, Subscriber> subscribers_;
  Number last_number_ = 0;
  /// Subscribers whose events are being merged.
  std::set<Number> merging_;
  RemoteInterests interests_;
  /// Without the figures of the flows.
  Counters counters_;
  std::vector<FilterIndex::Key> matched_;
};

} // namespace castor
