#pragma once

#include "castor/wm/values/timestamp.hpp"

#include <cstdint>
#include <map>

/// What the processes of a system with a simulated clock tell each other.
namespace castor {

/// Number of a process within its system, as in actors/link/actor_name.hpp.
using ClockMember = std::uint16_t;

/// Simulated time goes on to `time`. Rounds count from 1.
struct ClockAdvance {
  std::uint64_t round = 0;
  Timestamp time{0};

  friend bool operator==(const ClockAdvance&, const ClockAdvance&) = default;
};

/// Numbers of messages, by the other process.
struct MessageCounts {
  std::map<ClockMember, std::uint64_t> sent;
  std::map<ClockMember, std::uint64_t> received;

  friend bool operator==(const MessageCounts&, const MessageCounts&) = default;
};

/// Nobody in a process has anything to do in this round.
struct ClockReport {
  std::uint64_t round = 0;
  /// When the first of its sleepers is to be woken; `Timestamp::max()` if nobody sleeps.
  Timestamp next = Timestamp::max();
  MessageCounts counts;

  friend bool operator==(const ClockReport&, const ClockReport&) = default;
};

} // namespace castor
