#include "castor/mapping/body/corrected_pose.hpp"

#include "castor/mapping/planar/poses.hpp"

namespace castor::mapping {

namespace {

/// By how much a correction may be newer than odometry; microseconds.
constexpr std::int64_t newer = 500'000;

} // namespace

void CorrectedPose::add(const Odometry& x) {
  history_.add(x);
}

void CorrectedPose::correct(std::int64_t time, const Pose2& pose) {
  if (auto then = odometry_at(time))
    frame_ = compose(pose, inverse(*then));
}

std::optional<Pose2> CorrectedPose::now() const {
  auto newest = history_.newest();
  if (!frame_ || !newest)
    return std::nullopt;
  return compose(*frame_, newest->pose);
}

std::optional<Pose2> CorrectedPose::odometry_at(std::int64_t time) const {
  auto newest = history_.newest();
  if (newest && time > newest->time && time <= newest->time + newer)
    return newest->pose;
  return history_.pose_at(time);
}

} // namespace castor::mapping
