#pragma once

#include "castor/wm/values/timestamp.hpp"

#include <chrono>
#include <optional>

namespace castor {

/// A commander's estimate of its effector's clock, from the times that the effector's replies tell.
/// Never ahead of that clock, and behind it by the time that the best reply took at most: a command
/// stamped with it looks older than it is, and so never holds for too long.
class EffectorClock {
public:
  using Time = std::chrono::steady_clock::time_point;

  /// A reply arrived that tells the effector's time.
  void synchronise(Timestamp effector, Time now) {
    // Clocks drift apart by some 50 microseconds a second, so that replies of long ago may be
    // ahead.
    constexpr std::chrono::seconds remembered{2};
    if (!best_ || now > best_->received + remembered || effector > at(now))
      best_ = Reading{effector, now};
  }

  /// The effector's time; `synchronise` was called before.
  Timestamp at(Time now) const {
    return best_->effector + std::chrono::duration_cast<Timestamp>(now - best_->received);
  }

private:
  struct Reading {
    Timestamp effector{0};
    Time received;
  };

  std::optional<Reading> best_;
};

} // namespace castor
