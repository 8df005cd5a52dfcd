#pragma once

#include "castor/mapping/slam/correlative_matcher.hpp"
#include "castor/mapping/slam/placed_scan.hpp"
#include "castor/mapping/slam/scan_matcher.hpp"
#include "castor/mapping/slam/surface_points.hpp"
#include "castor/mapping/slam/types.hpp"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <utility>
#include <vector>

namespace castor::mapping {

struct LoopCloserOptions {
  /// A place is met again after at least this way, m, or after so many turns of the robot, radians.
  double least_path = 4;
  /// Earlier keyframes up to this distance may have seen the same, m; it grows by the window.
  double near = 1.5;
  /// Half the width of the search window, m: `window` and `drift` for each metre of the way from
  /// one to the other along the graph, `most_window` at most.
  double window = 0.2;
  double drift = 0.03;
  double most_window = 5;
  /// The same for the heading, radians.
  double window_heading = 0.1;
  double drift_heading = 0.01;
  double most_window_heading = 0.7;
  /// Windows up to this need no correlative search, m.
  double small_window = 0.35;
  /// Keyframes before and after the earlier one that the scan is matched against as well.
  std::int64_t neighbours = 7;
  /// Places that are tried for each keyframe.
  std::size_t most_places = 2;
  /// A search each time that the robot has moved this far, m, or turned this far, radians.
  double search_distance = 0.25;
  double search_turn = 0.2;
  double least_score = 0.55;
  double least_matched = 0.65;
  double most_deviation = 0.035;
  double least_observability = 0.03;
  /// Corrections beyond these need another closure that agrees, m and radians ...
  double large_correction = 0.4;
  double large_turn = 0.12;
  /// ... and all in windows beyond this, m, in which a place may be mistaken for another.
  double sure_window = 1;
  /// Both are so far from each other on the way, m, and those of large corrections this part of the
  /// window, too.
  double least_apart = 0.4;
  double confirmation = 0.5;
  /// Two closures agree up to this, m and radians.
  double agreement = 0.2;
  double agreement_heading = 0.06;
  /// A closure waits for another one on this way, m.
  double patience = 8;
  /// Deviation of a closure at least, m and radians.
  double deviation = 0.015;
  double deviation_heading = 0.005;
  /// Points that are further from their neighbours count alike, m.
  double spacing = 0.04;
  /// What has moved, by so many keyframes before and after, is left out.
  std::size_t witnesses = 15;
  MovedOptions moved;
  SurfaceOptions surface;
  ScanMatcherOptions matcher;
};

/// Finds out where the robot comes back to a place that it has seen before. Without threads and
/// clocks.
class LoopCloser {
public:
  explicit LoopCloser(const LoopCloserOptions& options = {});

  /// Takes a keyframe as known, without a search; the next number.
  void remember(const Keyframe& keyframe);

  /// Takes a loop constraint as known, between keyframes that are.
  void remember(const Constraint& loop);

  /// The next keyframe: constraints that follow from it, to be added to the graph.
  /// @param poses all keyframes in the map frame as far as is known, including this one
  std::vector<Constraint> add(const Keyframe& keyframe, const std::vector<Pose2>& poses);

  std::int64_t keyframes() const { return static_cast<std::int64_t>(known_.size()); }

private:
  struct Known {
    LaserScan scan;
    /// Length of the way up to here, m; turns count too.
    double path = 0;
    Pose2 local_pose;
    /// Keyframes at the other ends of loops.
    std::vector<std::int64_t> loops;
    /// Which of the surface points have moved; empty as long as it is one of the newest.
    std::vector<bool> moved;
  };

  struct Place {
    std::int64_t keyframe = 0;
    double distance = 0;
    /// Along the graph.
    double way = 0;
  };

  struct Closure {
    Constraint constraint;
    /// Half the width of the window that it was found in, m.
    double window = 0;
    /// It moves the robot far.
    bool is_large = false;
    /// It needs no other one.
    bool is_sure = false;
  };

  const Known& known(std::int64_t number) const { return known_[static_cast<std::size_t>(number)]; }
  /// Lets the newest keyframes tell what of one another has moved.
  void compare_with_newest(const Keyframe& keyframe);
  /// Surface points on the robot, without those that have moved.
  SurfacePoints standing_points(std::int64_t number) const;
  std::vector<double> ways_from(std::int64_t number) const;
  std::vector<Place> places_near(std::int64_t number, const std::vector<Pose2>& poses) const;
  SurfacePoints points_around(std::int64_t place, std::int64_t number,
                              const std::vector<Pose2>& poses) const;
  std::optional<Closure> close(const Place& place, std::int64_t number,
                               const std::vector<Pose2>& poses) const;
  /// What is certain now; keeps what is not.
  std::vector<Constraint> confirmed(const Closure& closure, const std::vector<Pose2>& poses);
  bool agree(const Constraint& a, const Constraint& b, const std::vector<Pose2>& poses) const;

  LoopCloserOptions options_;
  ScanMatcher matcher_;
  std::vector<Known> known_;
  /// The last of the known, in the front end's own frame.
  std::deque<PlacedScan> newest_;
  std::vector<Closure> waiting_;
  std::int64_t searched_ = 0;
};

} // namespace castor::mapping
