#pragma once

#include <atomic>
#include <thread>

namespace castor {

/// A mutex for a few instructions, which costs less than std::mutex where nobody else has it.
class SpinLock {
public:
  void lock() {
    for (int i = 0; flag_.test_and_set(std::memory_order_acquire); ++i)
      // Whoever has it may have been interrupted by the scheduler.
      if (i >= 100)
        std::this_thread::yield();
  }

  void unlock() { flag_.clear(std::memory_order_release); }

private:
  std::atomic_flag flag_ = ATOMIC_FLAG_INIT;
};

} // namespace castor
