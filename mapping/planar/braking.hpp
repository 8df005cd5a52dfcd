#pragma once

namespace castor::mapping {

/// The longest way that a robot needs to stop from `speed` does not exceed `way`: returns that
/// speed, m/s. It goes on for `latency` seconds before it brakes, at `braking` m/s^2.
double speed_to_stop_within(double way, double latency, double braking);

} // namespace castor::mapping
