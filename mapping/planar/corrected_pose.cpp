#include "castor/mapping/planar/corrected_pose.hpp"

#include "castor/mapping/planar/poses.hpp"

namespace castor::mapping {

namespace {

/// By how much a correction may be newer than odometry; microseconds.
constexpr std::int64_t newer = 500'000;

} // namespace

void CorrectedPose::add(const Odometry& x) {
  history_.add(x);
  if (!first_)
    first_ = x;
  if (waiting_)
    place(*waiting_);
}

void CorrectedPose::correct(std::int64_t time, const Pose2& pose) {
  waiting_ = {time, pose};
  place(*waiting_);
}

void CorrectedPose::place(Correction x) {
  if (const auto then = odometry_at(x.time))
    frame_ = compose(x.pose, inverse(*then));
  const auto newest = history_.newest();
  if (newest && newest->time >= x.time)
    waiting_.reset();
}

std::optional<Pose2> CorrectedPose::now() const {
  auto newest = history_.newest();
  if (!frame_ || !newest)
    return std::nullopt;
  return compose(*frame_, newest->pose);
}

std::optional<Pose2> CorrectedPose::odometry_at(std::int64_t time) const {
  if (first_ && time < first_->time)
    return first_->pose;
  auto newest = history_.newest();
  if (newest && time > newest->time && time <= newest->time + newer)
    return newest->pose;
  return history_.pose_at(time);
}

} // namespace castor::mapping
