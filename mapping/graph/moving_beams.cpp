#include "castor/mapping/graph/moving_beams.hpp"

#include "castor/mapping/planar/beams.hpp"

#include <algorithm>
#include <cstddef>

namespace castor::mapping {

std::vector<bool> MovingBeams::add(const ScanPtr& scan, const Pose2& robot) {
  const auto scanner = compose(robot, scan->mount);
  std::erase_if(seen_, [&](const View& x) {
    return x.scan().time < scan->time - options_.memory || x.scan().time > scan->time;
  });
  std::vector<bool> result(scan->ranges.size());
  for (std::size_t i = 0; i < result.size(); ++i) {
    const double range = scan->ranges[i];
    if (!(range > 0) || range >= scan->max_range)
      continue;
    const auto end = transform(scanner, end_of_beam(*scan, i));
    result[i] = std::ranges::count_if(seen_, [&](const View& x) {
                  return x.passes(end, options_.behind);
                }) >= options_.scans;
  }
  seen_.emplace_back(scan, robot);
  return result;
}

} // namespace castor::mapping
