#include "castor/mapping/slam/map_frame.hpp"

#include <cmath>

namespace castor::mapping {

PoseCovariance turned(const PoseCovariance& x, double heading) {
  auto c = std::cos(heading);
  auto s = std::sin(heading);
  PoseCovariance result;
  result.xx = c * c * x.xx - 2 * c * s * x.xy + s * s * x.yy;
  result.yy = s * s * x.xx + 2 * c * s * x.xy + c * c * x.yy;
  result.xy = c * s * (x.xx - x.yy) + (c * c - s * s) * x.xy;
  result.x_heading = c * x.x_heading - s * x.y_heading;
  result.y_heading = s * x.x_heading + c * x.y_heading;
  result.heading = x.heading;
  return result;
}

} // namespace castor::mapping
