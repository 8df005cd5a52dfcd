#pragma once

#include "castor/wm/events/event_backlog.hpp"
#include "castor/wm/events/receipts.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

namespace castor {

/// Default number of events that may wait for a receiver before they are merged.
inline constexpr std::uint32_t standard_queue_limit = 100'000;
inline constexpr std::uint32_t least_queue_limit = 16;

/// Flow control of events to one receiver: while `limit` (at least `least_queue_limit`) sent events
/// are unacknowledged, further ones wait in a backlog. A write of several entries is sent as a
/// whole, so the last one may exceed the limit. Events are merged only if more than `limit` of them
/// wait: the backlog has room for events that were taken but not yet acknowledged.
class EventFlow {
public:
  using Batch = EventBacklog::Batch;

  explicit EventFlow(std::uint32_t limit = standard_queue_limit)
    : limit_(std::max(limit, least_queue_limit)),
      backlog_(Receipts::batch_for(std::max(limit, least_queue_limit))) {}

  /// Returns the batch if it is to be sent at once; otherwise queues it.
  std::optional<Batch> push(Batch batch) {
    if (backlog_.empty() && in_flight_ < limit_)
      return sent(std::move(batch));
    backlog_.push(std::move(batch));
    return std::nullopt;
  }

  /// The receiver has taken `count` events. To be followed by calls of `next` until it returns
  /// nothing.
  void acknowledge(std::size_t count) { in_flight_ -= std::min(count, in_flight_); }

  /// Next waiting batch, if it may be sent now.
  std::optional<Batch> next() {
    if (backlog_.empty() || in_flight_ >= limit_)
      return std::nullopt;
    return sent(backlog_.pop());
  }

  /// Removes a withdrawn filter and its waiting events.
  void erase(std::uint32_t filter) { backlog_.erase(filter); }

  /// Number of events sent and not acknowledged.
  std::size_t in_flight() const { return in_flight_; }
  const EventBacklog& backlog() const { return backlog_; }

private:
  Batch sent(Batch batch) {
    in_flight_ += batch.size();
    return batch;
  }

  std::size_t limit_;
  std::size_t in_flight_ = 0;
  EventBacklog backlog_;
};

} // namespace castor
