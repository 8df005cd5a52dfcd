#pragma once

#include "castor/mapping/slam/front_end.hpp"
#include "castor/mapping/slam/loop_closer.hpp"
#include "castor/mapping/slam/pose_graph.hpp"

#include <cstdint>
#include <vector>

namespace castor::mapping {

struct SlamOptions {
  FrontEndOptions front_end;
  LoopCloserOptions loop_closer;
  PoseGraphOptions pose_graph;
  /// Loops are looked for; without, the path is the front end's.
  bool closes_loops = true;
  /// Poses are computed anew each time that there are so many new keyframes, if there are new
  /// loops ...
  std::int64_t keyframes_each_solve = 10;
  /// ... or at once, if a loop corrects by more than this, m.
  double correction_at_once = 0.1;
};

/// A pose of the robot at some time.
struct TimedPose {
  std::int64_t time = 0;
  Pose2 pose;
};

/// Front end, loop closing and pose graph one after the other, for logs: what the components do in
/// parallel.
class Slam {
public:
  explicit Slam(const SlamOptions& options = {});

  FrontEndStep add(const LaserScan& scan, const Pose2& odometry);

  /// Computes all poses for the last time.
  void finish();

  /// Pose of the robot at each scan, by what is known now.
  std::vector<TimedPose> path() const;

  const PoseGraph& graph() const { return graph_; }
  /// Scans that did not fit.
  std::size_t dead_reckoned() const { return dead_reckoned_; }

private:
  struct Seen {
    std::int64_t time;
    std::int64_t keyframe;
    Pose2 on_keyframe;
  };

  void add_keyframe(const FrontEndStep& step);

  SlamOptions options_;
  FrontEnd front_end_;
  LoopCloser loop_closer_;
  PoseGraph graph_;
  std::vector<Seen> seen_;
  std::int64_t keyframes_since_solve_ = 0;
  bool has_new_loops_ = false;
  std::size_t dead_reckoned_ = 0;
};

} // namespace castor::mapping
