#pragma once

#include "castor/mapping/slam/pose_graph.hpp"
#include "castor/mapping/slam/types.hpp"

#include <cstdint>
#include <map>
#include <utility>
#include <vector>

namespace castor::mapping {

struct GraphUpdaterOptions {
  PoseGraphOptions graph;
  /// Poses are computed anew each time that there are so many new keyframes, if there are new
  /// loops ...
  std::int64_t keyframes_each_solve = 10;
  /// ... or at once, if a loop corrects by more than this, m.
  double correction_at_once = 0.1;
};

/// Keyframes and constraints, in any order, and when their poses are to be computed. Without
/// threads and clocks.
class GraphUpdater {
public:
  explicit GraphUpdater(const GraphUpdaterOptions& options = {});

  /// Those that are there already are ignored.
  void add(const Keyframe& keyframe);
  void add(const Constraint& constraint);

  /// Goes on from poses that another one has computed: those of keyframes that are there.
  void restore(const GraphPoses& poses);

  /// Whether there is news that is worth computing.
  bool is_due() const;

  /// Computes all poses.
  GraphPoses solve();

  const PoseGraph& graph() const { return graph_; }

private:
  void take_keyframes();
  void take_loops();

  GraphUpdaterOptions options_;
  PoseGraph graph_;
  /// By number: of keyframes in the graph.
  std::vector<Pose2> local_poses_;
  std::vector<std::int64_t> times_;
  /// Of keyframes that wait for those before them, with their times.
  std::map<std::int64_t, std::pair<Pose2, std::int64_t>> waiting_;
  /// From one keyframe to the next, by the number of the latter; those that wait for it.
  std::map<std::int64_t, Constraint> steps_;
  std::vector<Constraint> waiting_loops_;
  /// Ends of all loops.
  std::map<std::pair<std::int64_t, std::int64_t>, bool> loops_;
  std::int64_t version_ = 0;
  std::size_t solved_keyframes_ = 0;
  std::size_t solved_loops_ = 0;
  double correction_ = 0;
};

/// Poses in the map frame of keyframes that have these local poses, by number: by the graph, and on
/// from it for those that it does not have yet.
std::vector<Pose2> keyframe_poses(const GraphPoses& graph, const std::vector<Pose2>& local_poses);

} // namespace castor::mapping
