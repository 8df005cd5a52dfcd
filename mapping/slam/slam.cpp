#include "castor/mapping/slam/slam.hpp"

#include "castor/mapping/planar/poses.hpp"

namespace castor::mapping {

Slam::Slam(const SlamOptions& options)
  : options_(options), front_end_(options.front_end), loop_closer_(options.loop_closer),
    graph_(options.graph) {}

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
    graph_.add(*step.constraint);
  graph_.add(*step.new_keyframe);
  if (!options_.closes_loops)
    return;
  for (const auto& loop : loop_closer_.add(*step.new_keyframe, graph().poses()))
    graph_.add(loop);
  if (graph_.is_due())
    graph_.solve();
}

void Slam::finish() {
  graph_.solve();
}

std::vector<TimedPose> Slam::path() const {
  auto poses = graph().poses();
  std::vector<TimedPose> result;
  result.reserve(seen_.size());
  for (const auto& x : seen_)
    result.push_back({x.time, compose(poses[static_cast<std::size_t>(x.keyframe)], x.on_keyframe)});
  return result;
}

} // namespace castor::mapping
