#include "castor/mapping/body/free_way.hpp"

#include "castor/mapping/planar/beams.hpp"
#include "castor/mapping/planar/poses.hpp"

#include <algorithm>
#include <cmath>

namespace castor::mapping {

double free_way(const LaserScan& scan, double half_width) {
  double result = scan.max_range;
  for (std::size_t i = 0; i < scan.ranges.size(); ++i) {
    if (!(scan.ranges[i] > 0))
      continue;
    const auto seen = transform(scan.mount, end_of_beam(scan, i));
    if (seen.x > 0 && std::abs(seen.y) < half_width)
      result = std::min(result, seen.x);
  }
  return result;
}

} // namespace castor::mapping
