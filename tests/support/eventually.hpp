#pragma once

#include <chrono>
#include <functional>
#include <thread>

namespace castor::test {

/// Waits until the condition holds; false if it does not within two minutes, which a busy machine
/// under sanitizers may need for what otherwise takes a second.
inline bool eventually(const std::function<bool()>& condition) {
  using namespace std::chrono_literals;
  auto until = std::chrono::steady_clock::now() + 2min;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > until)
      return false;
    std::this_thread::sleep_for(1ms);
  }
  return true;
}

} // namespace castor::test
