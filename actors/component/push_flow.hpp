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

/// Flow control of the pushes to one receiver: at most `limit` (at least 1) are sent and not
/// acknowledged. Of the others the newest wait, and older ones are dropped. Acknowledgements come
/// in batches, so one batch may wait: pushes are dropped only if the receiver has more than `limit`
/// that it has not taken, apart from acknowledgements under way.
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

  /// The receiver has taken `count` pushes. Call `next` afterwards until it returns nothing.
  void acknowledge(std::uint32_t count) { in_flight_ -= std::min(count, in_flight_); }

  /// The next waiting push, if it may be sent now.
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
