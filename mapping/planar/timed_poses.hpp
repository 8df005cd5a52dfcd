#pragma once

#include "castor/mapping/planar/poses.hpp"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <optional>

namespace castor::mapping {

/// Pose at that time, between the two around it; nothing before the first and after the last.
/// @param sorted elements with a `time` and a `pose`, in the order of time
template <class Range>
std::optional<Pose2> pose_between(const Range& sorted, std::int64_t time) {
  auto after = std::lower_bound(sorted.begin(), sorted.end(), time,
                                [](const auto& x, std::int64_t t) { return x.time < t; });
  if (after == sorted.end())
    return {};
  if (after->time == time)
    return after->pose;
  if (after == sorted.begin())
    return {};
  auto before = std::prev(after);
  auto share =
    static_cast<double>(time - before->time) / static_cast<double>(after->time - before->time);
  return interpolate(before->pose, after->pose, share);
}

} // namespace castor::mapping
