#include "castor/mapping/map_components/path_comparison.hpp"

#include "castor/mapping/map_components/median.hpp"
#include "castor/mapping/planar/poses.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace castor::mapping {

void PathComparison::add_truth(std::int64_t time, const Pose2& pose) {
  truths_.add({time, pose, {}});
  for (auto& keyframe : std::exchange(waiting_, {}))
    look_up(keyframe);
}

void PathComparison::look_up(const std::string& keyframe) {
  auto& x = places_.at(keyframe);
  x.truth = truths_.pose_at(x.time);
  auto newest = truths_.newest();
  if (!newest || newest->time < x.time)
    waiting_.insert(keyframe);
}

void PathComparison::place(const std::string& keyframe, std::int64_t time, const Pose2& pose) {
  auto& x = places_[keyframe];
  x.time = time;
  x.pose = pose;
  if (!x.truth)
    look_up(keyframe);
}

void PathComparison::remove(const std::string& keyframe) {
  places_.erase(keyframe);
  waiting_.erase(keyframe);
}

PathError PathComparison::error() const {
  PathError result;
  std::vector<double> distances;
  std::vector<double> turns;
  for (auto& [keyframe, x] : places_) {
    if (!x.truth)
      continue;
    distances.push_back(distance(x.pose, *x.truth));
    turns.push_back(std::abs(normalised(x.pose.heading - x.truth->heading)));
  }
  if (distances.empty())
    return result;
  result.keyframes = static_cast<std::int64_t>(distances.size());
  result.most = *std::ranges::max_element(distances);
  result.heading_most = *std::ranges::max_element(turns);
  result.median = median_of(distances);
  result.heading_median = median_of(turns);
  return result;
}

TruePath PathComparison::truth() const {
  std::map<std::int64_t, Pose2> by_time;
  for (auto& [keyframe, x] : places_)
    if (x.truth)
      by_time.emplace(x.time, *x.truth);
  TruePath result;
  for (auto& [time, pose] : by_time)
    result.poses.push_back(pose);
  return result;
}

} // namespace castor::mapping
