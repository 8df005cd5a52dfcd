#pragma once

#include "castor/actors/component/timer_id.hpp"

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <vector>

namespace castor {

/// Calls that are due again and again. Pure: time is an argument.
///
/// A call is due at a multiple of its period after it was added, however long earlier ones have
/// taken; those that were missed are left out.
class Timers {
public:
  using TimePoint = std::chrono::steady_clock::time_point;
  using Call = std::shared_ptr<const std::function<void()>>;

  TimerId add(std::chrono::nanoseconds period, TimePoint now, std::function<void()> call);
  void remove(TimerId id) { timers_.erase(id); }

  bool is_empty() const { return timers_.empty(); }

  /// When the next call is due; `TimePoint::max()` if there is none.
  TimePoint next() const;

  /// The calls that are due, in the order of their times; they are due again a period later.
  std::vector<std::pair<TimerId, Call>> take_due(TimePoint now);
  bool contains(TimerId id) const { return timers_.contains(id); }

private:
  struct Timer {
    std::chrono::nanoseconds period;
    TimePoint due;
    Call call;
  };

  std::map<TimerId, Timer> timers_;
  std::uint32_t last_id_ = 0;
};

} // namespace castor
