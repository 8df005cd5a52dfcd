#pragma once

#include "castor/wm/events/event_backlog.hpp"
#include "castor/wm/events/receipts.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

namespace castor {

/// How many events may wait for a receiver before they are merged, unless it says otherwise.
inline constexpr std::uint32_t standard_queue_limit = 100'000;
inline constexpr std::uint32_t least_queue_limit = 16;

/// Events on their way to one receiver, which is sent no more while there are `limit` (at least
/// `least_queue_limit`) that it has not taken; a write of several entries goes as one, so the last
/// may exceed that. The rest waits in a backlog. Nothing is merged unless more than `limit` events
/// wait: what was taken but not acknowledged has its place in the backlog.
class EventFlow {
public:
  using Batch = EventBacklog::Batch;

  explicit EventFlow(std::uint32_t limit = standard_queue_limit)
    : limit_(std::max(limit, least_queue_limit)),
      backlog_(Receipts::batch_for(std::max(limit, least_queue_limit))) {}

  /// Returns what is to be sent at once: the batch, or nothing.
  std::optional<Batch> push(Batch batch) {
    if (backlog_.empty() && in_flight_ < limit_)
      return sent(std::move(batch));
    backlog_.push(std::move(batch));
    return std::nullopt;
  }

  /// The receiver has taken so many. To be followed by `next`, until there is nothing.
  void acknowledge(std::size_t count) { in_flight_ -= std::min(count, in_flight_); }

  /// What may be sent now of that which waits.
  std::optional<Batch> next() {
    if (backlog_.empty() || in_flight_ >= limit_)
      return std::nullopt;
    return sent(backlog_.pop());
  }

  /// The filter is withdrawn: what waits for it is not sent.
  void erase(std::uint32_t filter) { backlog_.erase(filter); }

  /// Sent and not acknowledged.
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
