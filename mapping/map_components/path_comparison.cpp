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

void PathComparison::add_truths(const TruePath& known) {
  for (std::size_t i = 0; i < std::min(known.times.size(), known.poses.size()); ++i)
    former_truths_.insert_or_assign(known.times[i], known.poses[i]);
  for (auto& [keyframe, x] : places_)
    if (!x.truth)
      look_up(keyframe);
}

void PathComparison::look_up(const std::string& keyframe) {
  auto& x = places_.at(keyframe);
  if (auto former = former_truths_.find(x.time); former != former_truths_.end()) {
    x.truth = former->second;
    return;
  }
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
  std::vector<std::pair<Pose2, Pose2>> pairs;
  for (auto& [keyframe, x] : places_)
    if (x.truth)
      pairs.emplace_back(x.pose, *x.truth);
  PathError result;
  if (pairs.empty())
    return result;
  const auto alignment = best_alignment(pairs);
  std::vector<double> distances;
  std::vector<double> aligned;
  std::vector<double> turns;
  for (auto& [pose, truth] : pairs) {
    distances.push_back(distance(pose, truth));
    aligned.push_back(distance(compose(alignment, pose), truth));
    turns.push_back(std::abs(normalised(pose.heading - truth.heading)));
  }
  result.keyframes = static_cast<std::int64_t>(pairs.size());
  result.most = *std::ranges::max_element(distances);
  result.aligned_most = *std::ranges::max_element(aligned);
  result.heading_most = *std::ranges::max_element(turns);
  result.median = median_of(distances);
  result.aligned_median = median_of(aligned);
  result.heading_median = median_of(turns);
  return result;
}

TruePath PathComparison::truth() const {
  std::map<std::int64_t, Pose2> by_time;
  for (auto& [keyframe, x] : places_)
    if (x.truth)
      by_time.emplace(x.time, *x.truth);
  TruePath result;
  for (auto& [time, pose] : by_time) {
    result.times.push_back(time);
    result.poses.push_back(pose);
  }
  return result;
}

} // namespace castor::mapping
