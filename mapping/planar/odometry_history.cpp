#include "castor/mapping/planar/odometry_history.hpp"

#include "castor/mapping/planar/poses.hpp"

#include <algorithm>

namespace castor::mapping {

void OdometryHistory::add(const Odometry& x) {
  if (!known_.empty() && x.time <= known_.back().time)
    return;
  known_.push_back(x);
  while (known_.size() > most_)
    known_.pop_front();
}

std::optional<Pose2> OdometryHistory::pose_at(std::int64_t time) const {
  auto after = std::lower_bound(known_.begin(), known_.end(), time,
                                [](const Odometry& x, std::int64_t t) { return x.time < t; });
  if (after == known_.end())
    return {};
  if (after->time == time)
    return after->pose;
  if (after == known_.begin())
    return {};
  auto before = std::prev(after);
  auto share =
    static_cast<double>(time - before->time) / static_cast<double>(after->time - before->time);
  return interpolate(before->pose, after->pose, share);
}

std::optional<Odometry> OdometryHistory::newest() const {
  if (known_.empty())
    return {};
  return known_.back();
}

} // namespace castor::mapping
