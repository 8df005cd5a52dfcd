#pragma once

#include "castor/wm/clock/time_control.hpp"

#include <optional>

namespace castor {

/// Clock of a system.
struct ClockOptions {
  /// Pace of simulated time; nothing for the real clock.
  std::optional<Pace> pace;
  /// With simulated time, actors run one at a time, in an order that is always the same.
  bool reproducible = false;
};

} // namespace castor
