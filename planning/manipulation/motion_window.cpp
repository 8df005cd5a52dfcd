#include "castor/planning/manipulation/motion_window.hpp"

#include <cmath>

namespace castor::manipulation {

ArmCommand motion_window(const Trajectory& trajectory, std::int64_t motion, double time,
                         const WindowOptions& options) {
  ArmCommand result;
  result.motion = motion;
  result.interval = options.interval;
  const auto first = std::llround(std::floor((time - options.before) / options.interval));
  const auto last = std::llround(std::ceil((time + options.after) / options.interval));
  result.begin = static_cast<double>(first) * options.interval;
  for (auto i = first; i <= last; ++i) {
    const auto state = trajectory.at(static_cast<double>(i) * options.interval);
    result.positions.insert(result.positions.end(), state.positions.begin(), state.positions.end());
  }
  return result;
}

} // namespace castor::manipulation
