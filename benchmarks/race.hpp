#pragma once

#include <algorithm>
#include <atomic>
#include <barrier>
#include <chrono>
#include <cstddef>
#include <functional>
#include <vector>

namespace castor::benchmark {

using Clock = std::chrono::steady_clock;

/// Number of measurements.
inline int repetitions = 5;

inline double median(std::vector<double> x) {
  std::sort(x.begin(), x.end());
  return x.empty() ? 0 : x[x.size() / 2];
}

/// Several threads that do the same work at the same time, over and over.
class Race {
public:
  explicit Race(int threads) : threads_(threads), gate_(threads) {}

  /// Operations per second of all threads together (median). Called by each thread; returns the
  /// result to thread 0, and 0 to the others. `prepare` is not timed, and the first round is a
  /// warm-up.
  double measure(int thread, std::size_t operations, const std::function<void()>& prepare,
                 const std::function<void()>& work) {
    std::vector<double> rates;
    for (int i = 0; i <= repetitions; ++i) {
      auto seconds = round(prepare, work);
      if (i > 0)
        rates.push_back(static_cast<double>(operations) * threads_ / seconds);
    }
    return thread == 0 ? median(rates) : 0;
  }

  /// The same over as many rounds as take `duration` together (mean).
  double measure_for(std::chrono::duration<double> duration, int thread, std::size_t operations,
                     const std::function<void()>& prepare, const std::function<void()>& work) {
    double seconds = 0;
    double done = 0;
    round(prepare, work);
    for (bool goes_on = true; goes_on;) {
      seconds += round(prepare, work);
      done += static_cast<double>(operations) * threads_;
      // All threads have to agree on whether there is another round.
      if (thread == 0)
        goes_on_ = seconds < duration.count();
      gate_.arrive_and_wait();
      goes_on = goes_on_;
    }
    return thread == 0 ? done / seconds : 0;
  }

  /// Operations per second of all threads together, each of which repeats `work`, of so many
  /// operations, for `duration`, without waiting for the others. Returns as `measure` does.
  double measure_freely(std::chrono::duration<double> duration, int thread, std::size_t operations,
                        const std::function<void()>& work) {
    work();
    gate_.arrive_and_wait();
    double done = 0;
    auto begin = Clock::now();
    std::chrono::duration<double> taken{};
    while (taken < duration) {
      work();
      done += static_cast<double>(operations);
      taken = Clock::now() - begin;
    }
    total_ += done / taken.count();
    gate_.arrive_and_wait();
    return thread == 0 ? total_.exchange(0) : 0;
  }

private:
  /// Seconds of one round.
  double round(const std::function<void()>& prepare, const std::function<void()>& work) {
    prepare();
    gate_.arrive_and_wait();
    auto begin = Clock::now();
    work();
    gate_.arrive_and_wait();
    return std::chrono::duration<double>(Clock::now() - begin).count();
  }

  int threads_;
  bool goes_on_ = true;
  std::atomic<double> total_{0};
  std::barrier<> gate_;
};

} // namespace castor::benchmark
