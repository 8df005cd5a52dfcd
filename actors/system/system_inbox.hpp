#pragma once

#include "castor/actors/system/system_order.hpp"
#include "castor/wm/values/timestamp.hpp"

#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

namespace castor {

/// Requests of other threads to the main thread of a system: its end, and changes. Safe to use from
/// any thread.
class SystemInbox {
public:
  /// The first request counts.
  void end(int status, const std::string& reason);
  void add(SystemOrder x);

  /// From now on, `is_at_limit` is about this limit of simulated time, where it has not arrived
  /// yet.
  void await_limit(Timestamp x);
  /// Simulated time stands at this limit. One that is not awaited is ignored: it may be noted when
  /// there already is another.
  void note_limit(Timestamp x);
  bool is_at_limit() const;

  /// Status and reason, once the end was requested.
  std::optional<std::pair<int, std::string>> ended() const;
  std::deque<SystemOrder> take_orders();

  /// Waits for a request, or for the limit of simulated time, for `at_most`. Returns whether the
  /// end was requested.
  bool wait(std::chrono::milliseconds at_most);

private:
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<std::pair<int, std::string>> ended_;
  std::deque<SystemOrder> orders_;
  std::optional<Timestamp> limit_;
  bool is_at_limit_ = false;
};

} // namespace castor
