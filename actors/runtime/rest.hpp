#pragma once

#include <atomic>
#include <functional>
#include <utility>

namespace castor {

/// Time in which somebody looks less often whether there is anything to do, until somebody else
/// ends it because there is. Safe to use from any thread.
class Rest {
public:
  /// @param wake called when a rest is ended early, by the thread that ends it
  explicit Rest(std::function<void()> wake) : wake_(std::move(wake)) {}

  /// Whoever rests looks once more after this whether there is anything to do: `end` has no effect
  /// before.
  void begin() { is_on_ = true; }

  void end() {
    if (is_on_ && is_on_.exchange(false))
      wake_();
  }

private:
  std::atomic<bool> is_on_{false};
  const std::function<void()> wake_;
};

} // namespace castor
