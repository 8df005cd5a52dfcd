#pragma once

#include "castor/benchmarks/safety/injection.hpp"
#include "castor/mapping/body/types.hpp"

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>

namespace castor::benchmark {

/// What a simulated robot does, as its BodyStatus says. Times are those of the system, in
/// microseconds: of when the robot did something, not of when that arrived here. Thread-safe; its
/// waits end the process if nothing happens for a minute.
class BrakingWatch {
public:
  void add(const mapping::BodyStatus& x);

  /// Another system begins, whose times are others.
  void clear();

  /// Waits until the robot has driven at that speed, m/s, for a while.
  void await_cruise(double speed);

  /// Waits until the robot has lived to that time.
  void await(std::int64_t time);

  /// Waits until the robot is slower than it was at `begin`.
  void await_braking(std::int64_t begin);

  /// Waits until the robot stands.
  /// @param begin when the failure began
  /// @param braking of the robot, m/s^2
  Stop await_stop(std::int64_t begin, double braking);

private:
  using Samples = std::deque<mapping::BodyStatus>;

  /// At that time, or the first one after.
  Samples::const_iterator at(std::int64_t time) const;
  /// The first one since then with a speed of at most that, m/s.
  Samples::const_iterator slowed(std::int64_t begin, double speed) const;
  void wait(std::unique_lock<std::mutex>& guard, const std::function<bool()>& condition);

  std::mutex mutex_;
  std::condition_variable changed_;
  /// The newest, of ten seconds or so.
  Samples samples_;
};

} // namespace castor::benchmark
