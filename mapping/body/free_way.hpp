#pragma once

#include "castor/mapping/planar/types.hpp"

namespace castor::mapping {

/// How far the robot could drive straight on before something that the scan sees is within
/// `half_width` of the line that its middle drives on; metres from its middle, at most the scan's
/// greatest range. Beams without a return see nothing.
double free_way(const LaserScan& scan, double half_width);

} // namespace castor::mapping
