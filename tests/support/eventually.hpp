#pragma once

#include <chrono>
#include <functional>
#include <thread>

namespace castor::test {

/// Waits until the condition holds; false if it does not within 30 s.
inline bool eventually(const std::function<bool()>& condition) {
  using namespace std::chrono_literals;
  auto until = std::chrono::steady_clock::now() + 30s;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > until)
      return false;
    std::this_thread::sleep_for(1ms);
  }
  return true;
}

} // namespace castor::test
