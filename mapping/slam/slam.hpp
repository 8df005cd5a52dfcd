#pragma once

#include "castor/mapping/slam/front_end.hpp"
#include "castor/mapping/slam/graph_updater.hpp"
#include "castor/mapping/slam/loop_closer.hpp"

#include <cstdint>
#include <vector>

namespace castor::mapping {

struct SlamOptions {
  FrontEndOptions front_end;
  LoopCloserOptions loop_closer;
  GraphUpdaterOptions graph;
  /// Loops are looked for; without, the path is the front end's.
  bool closes_loops = true;
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

  const PoseGraph& graph() const { return graph_.graph(); }
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
  GraphUpdater graph_;
  std::vector<Seen> seen_;
  std::size_t dead_reckoned_ = 0;
};

} // namespace castor::mapping
