#include "castor/mapping/body/corrected_pose.hpp"

#include <algorithm>

namespace castor::mapping {

namespace {

/// How long odometry is remembered, and by how much a correction may be newer than it; in
/// microseconds.
constexpr std::int64_t remembered = 10'000'000;
constexpr std::int64_t newer = 500'000;

} // namespace

void CorrectedPose::add(const Odometry& x) {
  if (!history_.empty() && x.time <= history_.back().time)
    return;
  history_.push_back(x);
  while (history_.front().time < x.time - remembered)
    history_.pop_front();
}

void CorrectedPose::correct(std::int64_t time, const Pose2& pose) {
  if (auto then = odometry_at(time))
    frame_ = compose(pose, inverse(*then));
}

std::optional<Pose2> CorrectedPose::now() const {
  if (!frame_ || history_.empty())
    return std::nullopt;
  return compose(*frame_, history_.back().pose);
}

std::optional<Pose2> CorrectedPose::odometry_at(std::int64_t time) const {
  if (history_.empty() || time > history_.back().time + newer)
    return std::nullopt;
  const auto after = std::ranges::lower_bound(history_, time, {}, &Odometry::time);
  if (after == history_.end())
    return history_.back().pose;
  if (after->time == time)
    return after->pose;
  if (after == history_.begin())
    return std::nullopt;
  const auto& before = *std::prev(after);
  const double share =
    static_cast<double>(time - before.time) / static_cast<double>(after->time - before.time);
  return interpolate(before.pose, after->pose, share);
}

} // namespace castor::mapping
