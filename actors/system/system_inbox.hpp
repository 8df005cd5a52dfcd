#pragma once

#include "castor/actors/system/system_order.hpp"

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

  /// Status and reason, once the end was requested.
  std::optional<std::pair<int, std::string>> ended() const;
  std::deque<SystemOrder> take_orders();

  /// Waits for a request, for `at_most`. Returns whether the end was requested.
  bool wait(std::chrono::milliseconds at_most);

private:
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::optional<std::pair<int, std::string>> ended_;
  std::deque<SystemOrder> orders_;
};

} // namespace castor
