#include "castor/benchmarks/safety/braking_watch.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <iterator>

namespace castor::benchmark {

namespace {

using namespace std::chrono_literals;

/// A robot that is so much slower brakes, m/s.
constexpr double slower = 0.05;

double milliseconds(std::int64_t microseconds) {
  constexpr double thousand = 1000;
  return static_cast<double>(microseconds) / thousand;
}

} // namespace

void BrakingWatch::add(const mapping::BodyStatus& x) {
  const std::lock_guard guard{mutex_};
  samples_.push_back(x);
  constexpr std::size_t most = 1000;
  if (samples_.size() > most)
    samples_.pop_front();
  changed_.notify_all();
}

void BrakingWatch::clear() {
  const std::lock_guard guard{mutex_};
  samples_.clear();
}

void BrakingWatch::wait(std::unique_lock<std::mutex>& guard,
                        const std::function<bool()>& condition) {
  if (changed_.wait_for(guard, 60s, condition))
    return;
  std::fputs("safety_benchmark: the robot has not changed its speed for a minute\n", stderr);
  std::_Exit(1);
}

BrakingWatch::Samples::const_iterator BrakingWatch::at(std::int64_t time) const {
  return std::ranges::find_if(samples_, [&](const auto& x) { return x.time >= time; });
}

BrakingWatch::Samples::const_iterator BrakingWatch::slowed(std::int64_t begin, double speed) const {
  return std::find_if(at(begin), samples_.end(),
                      [&](const auto& x) { return x.velocity.forward <= speed; });
}

void BrakingWatch::await_cruise(double speed) {
  std::unique_lock guard{mutex_};
  wait(guard, [&] {
    constexpr std::ptrdiff_t samples = 30;
    return std::ssize(samples_) > samples &&
           std::all_of(samples_.end() - samples, samples_.end(),
                       [&](const auto& x) { return x.velocity.forward > speed - slower / 2; });
  });
}

void BrakingWatch::await(std::int64_t time) {
  std::unique_lock guard{mutex_};
  wait(guard, [&] { return at(time) != samples_.end(); });
}

void BrakingWatch::await_braking(std::int64_t begin) {
  await(begin);
  std::unique_lock guard{mutex_};
  const double cruise = at(begin)->velocity.forward;
  wait(guard, [&] { return slowed(begin, cruise - slower) != samples_.end(); });
}

Stop BrakingWatch::await_stop(std::int64_t begin, double braking) {
  await_braking(begin);
  std::unique_lock guard{mutex_};
  wait(guard, [&] { return slowed(begin, 0) != samples_.end(); });
  const auto first = at(begin);
  const double cruise = first->velocity.forward;
  const auto brakes = slowed(begin, cruise - slower);
  const auto stands = slowed(begin, 0);
  constexpr double second = 1000; // ms
  Stop result;
  // It has braked since it had its speed.
  result.braked_ms =
    milliseconds(brakes->time - begin) - second * (cruise - brakes->velocity.forward) / braking;
  result.stood_ms = milliseconds(stands->time - begin);
  result.way = stands->driven - first->driven;
  result.collisions = stands->collisions;
  return result;
}

} // namespace castor::benchmark
