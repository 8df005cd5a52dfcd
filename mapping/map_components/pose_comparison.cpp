#include "castor/mapping/map_components/pose_comparison.hpp"

#include "castor/mapping/map_components/median.hpp"
#include "castor/mapping/planar/poses.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace castor::mapping {

void PoseComparison::add_truth(std::int64_t time, const Pose2& pose) {
  truths_.add({time, pose, {}});
  compare_waiting();
}

void PoseComparison::add_pose(const RobotPose& x) {
  waiting_.push_back(x);
  compare_waiting();
}

void PoseComparison::compare_waiting() {
  auto newest = truths_.newest();
  while (newest && !waiting_.empty() && waiting_.front().time <= newest->time) {
    auto x = std::move(waiting_.front());
    waiting_.pop_front();
    auto before = std::exchange(state_, x.state);
    error_.time = x.time;
    ++error_.poses;
    if (x.state == LocalisationState::lost && before != LocalisationState::lost) {
      ++error_.lost;
      error_.last_lost = x.time;
    }
    if (x.state != LocalisationState::tracking)
      continue;
    ++error_.tracking;
    if (before == LocalisationState::starting || before == LocalisationState::lost)
      error_.last_found = x.time;
    auto truth = truths_.pose_at(x.time);
    if (!truth)
      continue;
    distances_.push_back(distance(x.pose, *truth));
    turns_.push_back(std::abs(normalised(x.pose.heading - truth->heading)));
  }
}

PoseError PoseComparison::error() const {
  auto result = error_;
  if (distances_.empty())
    return result;
  result.median = median_of(distances_);
  result.most = *std::ranges::max_element(distances_);
  result.heading_median = median_of(turns_);
  result.heading_most = *std::ranges::max_element(turns_);
  return result;
}

} // namespace castor::mapping
