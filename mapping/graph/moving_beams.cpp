#include "castor/mapping/graph/moving_beams.hpp"

#include "castor/mapping/graph/beam_towards.hpp"
#include "castor/mapping/planar/beams.hpp"

#include <cmath>
#include <cstddef>

namespace castor::mapping {

namespace {

/// Whether the beam towards a point on the scanner and both beside it go on behind it.
bool was_free(const LaserScan& scan, const Point2& point, double behind) {
  const auto way = std::hypot(point.x, point.y);
  const auto beam = beam_towards(scan, point);
  if (!beam)
    return false;
  for (auto i = *beam - 1; i <= *beam + 1; ++i) {
    // Without a return, nothing is known.
    if (!(scan.ranges[i] > way + behind))
      return false;
  }
  return true;
}

} // namespace

std::vector<bool> MovingBeams::add(const ScanPtr& scan, const Pose2& robot) {
  const auto scanner = compose(robot, scan->mount);
  std::erase_if(seen_, [&](const Seen& x) {
    return x.scan->time < scan->time - options_.memory || x.scan->time > scan->time;
  });
  std::vector<bool> result(scan->ranges.size());
  std::vector<Pose2> scanner_there;
  scanner_there.reserve(seen_.size());
  for (auto& x : seen_)
    scanner_there.push_back(between(x.scanner, scanner));
  for (std::size_t i = 0; i < result.size(); ++i) {
    const double range = scan->ranges[i];
    if (!(range > 0) || range >= scan->max_range)
      continue;
    const auto end = end_of_beam(*scan, i);
    int free = 0;
    for (std::size_t k = 0; k < seen_.size() && free < options_.scans; ++k)
      free += was_free(*seen_[k].scan, transform(scanner_there[k], end), options_.behind) ? 1 : 0;
    result[i] = free >= options_.scans;
  }
  seen_.push_back({scan, scanner});
  return result;
}

} // namespace castor::mapping
