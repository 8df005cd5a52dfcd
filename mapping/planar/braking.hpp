#pragma once

namespace castor::mapping {

/// The greatest speed, m/s, from which a robot stops within `way` metres if it goes on for
/// `latency` seconds before it brakes, at `braking` m/s^2.
double speed_to_stop_within(double way, double latency, double braking);

} // namespace castor::mapping
