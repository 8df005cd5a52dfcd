#pragma once

#include "castor/actors/link/dial.hpp"
#include "castor/tools/chaos/quantities.hpp"

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <thread>

namespace castor::faults {

/// A flood of connections to a listening process that send nothing, an invalid greeting, or an
/// incomplete one. They are made on a thread of their own.
class ConnectionFlood {
public:
  ConnectionFlood(Endpoint to, Rate rate);
  ConnectionFlood(const ConnectionFlood&) = delete;
  ConnectionFlood& operator=(const ConnectionFlood&) = delete;
  ~ConnectionFlood();

  struct Counts {
    std::uint64_t connected = 0;
    /// Connections that could not be made.
    std::uint64_t failed = 0;
  };

  /// Stops connecting and closes all open connections.
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
