#pragma once

#include "castor/wm/clock/simulated_clock.hpp"

#include <atomic>
#include <memory>
#include <utility>

namespace castor {

/// The simulated clock of a mesh, set at most once; none as long as the clock is the real one. Safe
/// to use from any thread.
class LinkClock {
public:
  void set(std::shared_ptr<SimulatedClock> x) {
    owner_ = std::move(x);
    clock_.store(owner_.get());
  }

  SimulatedClock* get() const { return clock_.load(); }

private:
  std::shared_ptr<SimulatedClock> owner_;
  std::atomic<SimulatedClock*> clock_{nullptr};
};

} // namespace castor
