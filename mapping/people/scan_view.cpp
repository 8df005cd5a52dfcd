#include "castor/mapping/people/scan_view.hpp"

#include <algorithm>
#include <cmath>

namespace castor::mapping {

ScanView::ScanView(const LaserScan& scan, const Pose2& robot)
  : scan_(scan), from_scanner_(inverse(compose(robot, scan.mount))) {
  // nop
}

ScanView::Shares ScanView::towards(const Point2& place, double radius) const {
  const auto seen = transform(from_scanner_, place);
  const double away = std::hypot(seen.x, seen.y);
  if (away <= radius || !(scan_.angle_step > 0))
    return {};
  const double direction = std::atan2(seen.y, seen.x);
  const double half = std::asin(radius / away);
  const auto beam_at = [&](double angle) {
    return static_cast<long>(std::lround((angle - scan_.first_angle) / scan_.angle_step));
  };
  const long first = beam_at(direction - half);
  const long last = std::max(first, beam_at(direction + half));
  const auto beams = static_cast<long>(scan_.ranges.size());
  double hidden = 0;
  double passed = 0;
  for (long i = first; i <= last; ++i) {
    if (i < 0 || i >= beams) {
      ++hidden;
      continue;
    }
    const double range = scan_.ranges[static_cast<std::size_t>(i)];
    if (!(range > 0) || range > away + radius)
      ++passed;
    else if (range < away - radius)
      ++hidden;
  }
  const auto all = static_cast<double>(last - first + 1);
  return {hidden / all, passed / all};
}

} // namespace castor::mapping
