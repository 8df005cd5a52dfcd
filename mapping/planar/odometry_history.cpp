#include "castor/mapping/planar/odometry_history.hpp"

#include "castor/mapping/planar/timed_poses.hpp"

namespace castor::mapping {

void OdometryHistory::add(const Odometry& x) {
  if (!known_.empty() && x.time <= known_.back().time)
    return;
  known_.push_back(x);
  while (known_.size() > most_)
    known_.pop_front();
}

std::optional<Pose2> OdometryHistory::pose_at(std::int64_t time) const {
  return pose_between(known_, time);
}

std::optional<Odometry> OdometryHistory::newest() const {
  if (known_.empty())
    return {};
  return known_.back();
}

} // namespace castor::mapping
