#include "castor/mapping/slam/slam.hpp"

#include "castor/mapping/planar/poses.hpp"

#include <algorithm>

namespace castor::mapping {

Slam::Slam(const SlamOptions& options)
  : options_(options), front_end_(options.front_end), loop_closer_(options.loop_closer),
    graph_(options.pose_graph) {}

FrontEndStep Slam::add(const LaserScan& scan, const Pose2& odometry) {
  auto step = front_end_.add(scan, odometry);
  if (step.state == LocalisationState::dead_reckoning)
    ++dead_reckoned_;
  if (step.new_keyframe)
    add_keyframe(step);
  seen_.push_back({step.time, step.keyframe, step.on_keyframe});
  return step;
}

void Slam::add_keyframe(const FrontEndStep& step) {
  if (step.constraint)
    graph_.add_pose(*step.constraint);
  else
    graph_.add_pose(step.local_pose);
  ++keyframes_since_solve_;
  if (!options_.closes_loops)
    return;
  auto correction = 0.;
  for (const auto& loop : loop_closer_.add(*step.new_keyframe, graph_.poses())) {
    auto predicted = between(graph_.pose(loop.from), graph_.pose(loop.to));
    correction = std::max(correction, distance(predicted, loop.pose));
    graph_.add(loop);
    has_new_loops_ = true;
  }
  if (!has_new_loops_ || (keyframes_since_solve_ < options_.keyframes_each_solve &&
                          correction <= options_.correction_at_once))
    return;
  graph_.solve();
  keyframes_since_solve_ = 0;
  has_new_loops_ = false;
}

void Slam::finish() {
  graph_.solve();
}

std::vector<TimedPose> Slam::path() const {
  std::vector<TimedPose> result;
  result.reserve(seen_.size());
  for (const auto& x : seen_)
    result.push_back({x.time, compose(graph_.pose(x.keyframe), x.on_keyframe)});
  return result;
}

} // namespace castor::mapping
