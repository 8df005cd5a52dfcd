#pragma once

#include "castor/actors/link/dial.hpp"
#include "castor/tools/chaos/quantities.hpp"

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <thread>

namespace castor::faults {

/// Connections to a listening process by strangers, who say nothing, or what is no greeting, or
/// only the beginning of one. They are made on a thread of their own.
class Strangers {
public:
  Strangers(Endpoint to, Rate rate);
  Strangers(const Strangers&) = delete;
  Strangers& operator=(const Strangers&) = delete;
  ~Strangers();

  struct Counts {
    std::uint64_t connected = 0;
    /// Connections that could not be made.
    std::uint64_t failed = 0;
  };

  /// No more of them; those that there are leave.
  Counts stop();

private:
  void work();

  const Endpoint to_;
  const std::chrono::nanoseconds interval_;
  std::mutex mutex_;
  std::condition_variable changed_;
  bool over_ = false;
  Counts counts_;
  std::thread thread_;
};

} // namespace castor::faults
