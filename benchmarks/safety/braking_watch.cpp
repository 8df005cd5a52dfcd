#include "castor/benchmarks/safety/braking_watch.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <iterator>

namespace castor::benchmark {

namespace {

using namespace std::chrono_literals;

/// A robot that is so much slower brakes, m/s.
constexpr double slower = 0.05;

} // namespace

void BrakingWatch::add(const mapping::BodyStatus& x) {
  const std::lock_guard guard{mutex_};
  samples_.push_back({x, Clock::now()});
  constexpr std::size_t most = 1000;
  if (samples_.size() > most)
    samples_.pop_front();
  changed_.notify_all();
}

void BrakingWatch::wait(std::unique_lock<std::mutex>& guard,
                        const std::function<bool()>& condition) {
  if (changed_.wait_for(guard, 60s, condition))
    return;
  std::fputs("safety_benchmark: nothing has changed for a minute\n", stderr);
  std::_Exit(1);
}

mapping::BodyStatus BrakingWatch::await_cruise(double speed) {
  std::unique_lock guard{mutex_};
  wait(guard, [&] {
    constexpr std::ptrdiff_t samples = 30;
    return std::ssize(samples_) > samples &&
           std::all_of(samples_.end() - samples, samples_.end(), [&](const Sample& x) {
             return x.status.velocity.forward > speed - slower / 2;
           });
  });
  return samples_.back().status;
}

BrakingWatch::Stop BrakingWatch::await_stop(Clock::time_point begin, const mapping::BodyStatus& at,
                                            double braking) {
  Stop result;
  const double cruise = at.velocity.forward;
  const auto after = [&](const Sample& x) { return x.time >= begin; };
  std::unique_lock guard{mutex_};
  const auto found = [&](double below) {
    return std::ranges::find_if(
      samples_, [&](const Sample& x) { return after(x) && x.status.velocity.forward <= below; });
  };
  wait(guard, [&] { return found(0) != samples_.end(); });
  // It has braked since it had its speed.
  const auto brakes = found(cruise - slower);
  const std::chrono::duration<double> since{(cruise - brakes->status.velocity.forward) / braking};
  result.braked = brakes->time - begin - std::chrono::duration_cast<Clock::duration>(since);
  const auto stands = found(0);
  result.stood = stands->time - begin;
  result.way = stands->status.driven - at.driven;
  return result;
}

std::int64_t BrakingWatch::collisions() {
  const std::lock_guard guard{mutex_};
  return samples_.empty() ? 0 : samples_.back().status.collisions;
}

} // namespace castor::benchmark
