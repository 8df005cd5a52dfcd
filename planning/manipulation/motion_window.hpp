#pragma once

#include "castor/planning/manipulation/trajectory.hpp"
#include "castor/planning/manipulation/types.hpp"

#include <cstdint>

namespace castor::manipulation {

struct WindowOptions {
  /// Seconds between configurations, of the motion before the time that the arm has come to, and
  /// after it. The part after it is more than the arm goes on while it comes to rest.
  double interval = 0.04;
  double before = 0.12;
  double after = 1.6;
};

/// The command that lets an arm go on along a trajectory from about that time on; its gripper and
/// `pushes` are not set. Commands of one motion have the same configurations where they meet. After
/// its end, the trajectory rests.
ArmCommand motion_window(const Trajectory& trajectory, std::int64_t motion, double time,
                         const WindowOptions& options = {});

} // namespace castor::manipulation
