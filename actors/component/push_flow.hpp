#pragma once

#include "castor/wm/events/receipts.hpp"
#include "castor/wm/values/value.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <utility>

namespace castor {

/// How many pushes of one type may wait for a component, unless it says otherwise.
inline constexpr std::uint32_t standard_push_limit = 100;

/// Pushes on their way to one receiver, which is sent no more while there are `limit` (at least 1)
/// that it has not acknowledged. Of the rest the newest wait, and the older ones are dropped. That
/// happens only if more than `limit` pushes are not taken, acknowledgements on their way apart:
/// what was taken but not acknowledged has its place among those that wait.
class PushFlow {
public:
  explicit PushFlow(std::uint32_t limit)
    : limit_(std::max(limit, 1U)), room_(Receipts::batch_for(limit)) {}

  /// Returns what is to be sent at once: the push, or nothing.
  std::optional<Value> push(Value x) {
    if (waiting_.empty() && in_flight_ < limit_)
      return sent(std::move(x));
    if (waiting_.size() == room_) {
      waiting_.pop_front();
      ++dropped_;
    }
    waiting_.push_back(std::move(x));
    return std::nullopt;
  }

  /// The receiver has taken so many. To be followed by `next`, until there is nothing.
  void acknowledge(std::uint32_t count) { in_flight_ -= std::min(count, in_flight_); }

  /// What may be sent now of that which waits.
  std::optional<Value> next() {
    if (waiting_.empty() || in_flight_ >= limit_)
      return std::nullopt;
    auto x = std::move(waiting_.front());
    waiting_.pop_front();
    return sent(std::move(x));
  }

  std::uint32_t limit() const { return limit_; }

  /// Sent and not acknowledged.
  std::uint32_t in_flight() const { return in_flight_; }
  std::size_t waiting() const { return waiting_.size(); }
  std::uint64_t dropped() const { return dropped_; }

private:
  Value sent(Value x) {
    ++in_flight_;
    return x;
  }

  std::uint32_t limit_;
  std::size_t room_;
  std::uint32_t in_flight_ = 0;
  std::deque<Value> waiting_;
  std::uint64_t dropped_ = 0;
};

} // namespace castor
