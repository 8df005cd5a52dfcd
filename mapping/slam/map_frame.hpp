#pragma once

#include "castor/mapping/slam/types.hpp"

namespace castor::mapping {

/// Covariance of a pose in another frame, in which the first frame is turned by `heading`.
PoseCovariance turned(const PoseCovariance& x, double heading);

} // namespace castor::mapping
