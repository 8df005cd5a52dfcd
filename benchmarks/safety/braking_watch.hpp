#pragma once

#include "castor/mapping/body/types.hpp"

#include <chrono>
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>

namespace castor::benchmark {

/// What a simulated robot does, as its BodyStatus says, with the times at which that arrived.
/// Thread-safe; its waits end the process if nothing happens for a minute.
class BrakingWatch {
public:
  using Clock = std::chrono::steady_clock;

  void add(const mapping::BodyStatus& x);

  /// Waits until the robot has driven at that speed, m/s, for a while.
  mapping::BodyStatus await_cruise(double speed);

  struct Stop {
    /// From `begin` until the robot brakes, and until it stands.
    Clock::duration braked{};
    Clock::duration stood{};
    /// Way from `begin`, metres.
    double way = 0;
  };

  /// Waits until the robot stands.
  /// @param begin when the failure began; `at` is the status then
  /// @param braking of the robot, m/s^2
  Stop await_stop(Clock::time_point begin, const mapping::BodyStatus& at, double braking);

  std::int64_t collisions();

private:
  struct Sample {
    mapping::BodyStatus status;
    Clock::time_point time;
  };

  void wait(std::unique_lock<std::mutex>& guard, const std::function<bool()>& condition);

  std::mutex mutex_;
  std::condition_variable changed_;
  /// The newest, of ten seconds or so.
  std::deque<Sample> samples_;
};

} // namespace castor::benchmark
