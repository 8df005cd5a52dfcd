#include "castor/mapping/slam/graph_updater.hpp"

#include "castor/mapping/planar/poses.hpp"

#include <algorithm>

namespace castor::mapping {

GraphUpdater::GraphUpdater(const GraphUpdaterOptions& options)
  : options_(options), graph_(options.graph) {}

void GraphUpdater::add(const Keyframe& keyframe) {
  if (keyframe.number < static_cast<std::int64_t>(graph_.size()))
    return;
  waiting_.emplace(keyframe.number, std::pair{keyframe.local_pose, keyframe.time});
  take_keyframes();
}

void GraphUpdater::add(const Constraint& constraint) {
  if (constraint.kind != ConstraintKind::loop) {
    steps_.emplace(constraint.to, constraint);
    take_keyframes();
  } else if (loops_.emplace(std::pair{constraint.from, constraint.to}, true).second) {
    waiting_loops_.push_back(constraint);
    take_loops();
  }
}

void GraphUpdater::take_keyframes() {
  for (;;) {
    auto number = static_cast<std::int64_t>(graph_.size());
    auto next = waiting_.find(number);
    auto step = steps_.find(number);
    if (next == waiting_.end() || (number > 0 && step == steps_.end()))
      break;
    if (number == 0)
      graph_.add_pose(next->second.first);
    else
      graph_.add_pose(step->second);
    local_poses_.push_back(next->second.first);
    times_.push_back(next->second.second);
    waiting_.erase(next);
    if (step != steps_.end())
      steps_.erase(step);
  }
  take_loops();
}

void GraphUpdater::take_loops() {
  auto size = static_cast<std::int64_t>(graph_.size());
  std::erase_if(waiting_loops_, [&](const Constraint& x) {
    if (x.from >= size || x.to >= size)
      return false;
    auto predicted = between(graph_.pose(x.from), graph_.pose(x.to));
    correction_ = std::max(correction_, distance(predicted, x.pose));
    graph_.add(x);
    return true;
  });
}

void GraphUpdater::restore(const GraphPoses& poses) {
  for (std::size_t i = 0; i < std::min(poses.poses.size(), graph_.size()); ++i)
    graph_.move(static_cast<std::int64_t>(i), poses.poses[i]);
  version_ = std::max(version_, poses.version);
  // Steps lead on from the last of them.
  for (auto i = poses.poses.size(); i > 0 && i < graph_.size(); ++i)
    graph_.move(static_cast<std::int64_t>(i),
                compose(graph_.pose(static_cast<std::int64_t>(i) - 1),
                        between(local_poses_[i - 1], local_poses_[i])));
}

bool GraphUpdater::is_due() const {
  if (graph_.size() > 0 && version_ == 0)
    return true;
  if (graph_.loops() == solved_loops_)
    return false;
  return correction_ > options_.correction_at_once ||
         graph_.size() >=
           solved_keyframes_ + static_cast<std::size_t>(options_.keyframes_each_solve);
}

GraphPoses GraphUpdater::solve() {
  graph_.solve();
  solved_keyframes_ = graph_.size();
  solved_loops_ = graph_.loops();
  correction_ = 0;
  GraphPoses result;
  result.version = ++version_;
  result.poses = graph_.poses();
  result.loops = static_cast<std::int64_t>(graph_.loops());
  result.doubted_loops = static_cast<std::int64_t>(graph_.doubted_loops());
  if (!times_.empty()) {
    result.time = times_.back();
    result.local_frame = compose(result.poses.back(), inverse(local_poses_.back()));
  }
  return result;
}

std::vector<Pose2> keyframe_poses(const GraphPoses& graph, const std::vector<Pose2>& local_poses) {
  std::vector<Pose2> result;
  result.reserve(local_poses.size());
  for (std::size_t i = 0; i < local_poses.size(); ++i)
    result.push_back(i < graph.poses.size() ? graph.poses[i]
                                            : compose(graph.local_frame, local_poses[i]));
  return result;
}

} // namespace castor::mapping
