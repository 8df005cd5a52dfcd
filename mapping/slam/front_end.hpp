#pragma once

#include "castor/mapping/slam/correlative_matcher.hpp"
#include "castor/mapping/slam/local_map.hpp"
#include "castor/mapping/slam/narrow_things.hpp"
#include "castor/mapping/slam/scan_matcher.hpp"
#include "castor/mapping/slam/surface_points.hpp"
#include "castor/mapping/slam/types.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace castor::mapping {

/// The metric by which scans are aligned.
enum class MatchingMethod {
  /// ScanMatcher.
  point_to_line,
  /// IcpMatcher, a baseline.
  icp
};

struct FrontEndOptions {
  /// A keyframe is made each time that the robot has moved this far, m ...
  double keyframe_distance = 0.15;
  /// ... or turned this far, radians.
  double keyframe_turn = 0.12;
  /// What a scan is matched against.
  LocalMapOptions map;
  /// Deviation of odometry, as a share of the distance and of the angle turned ...
  double odometry_translation = 0.1;
  double odometry_turn = 0.1;
  /// ... and turning by the way, radians per metre ...
  double odometry_drift = 0.1;
  /// ... and what there is at rest, m and radians.
  double odometry_rest = 0.01;
  double odometry_rest_heading = 0.01;
  /// Where odometry and going on as before differ by more, m and radians, both are tried: odometry
  /// may be late.
  double late_odometry = 0.05;
  double late_odometry_heading = 0.05;
  /// Other poses than that by odometry count if so many more of the scan's points are on known
  /// surfaces then.
  double search_gain = 0.05;
  /// Deviation of a step from keyframe to keyframe at least, m and radians: neighbouring beams err
  /// together.
  double motion_deviation = 0.004;
  double motion_deviation_heading = 0.002;
  /// Scans of which less is on known surfaces are looked for around the prediction, too.
  double sure_matched = 0.8;
  /// Scans of which less is on known surfaces do not fit.
  double least_matched = 0.4;
  /// If what seems to have moved is more of a scan, it is the robot that is elsewhere.
  double most_moved = 0.4;
  /// A match that is further from the wheels than so many of their deviations may have followed
  /// somebody who walks: it has if what is wider than a person fits where the wheels are, or even
  /// on the other side of them.
  double believed_deviations = 2;
  NarrowOptions narrow;
  /// Where fewer of the points than this share notice movement in some direction, they may be of
  /// somebody who walks: further from the wheels and from going on as before than so many
  /// deviations, the wheels count in that direction.
  double few_points = 0.15;
  double most_deviations = 3;
  /// Score of a correlative match that is good enough to go on from it.
  double least_score = 0.5;
  /// Odometry that moves faster has jumped, m/s and rad/s.
  double most_speed = 4;
  double most_turn = 7;
  /// After so long without a scan the path has a gap, s.
  double gap = 1;
  /// Points that are further from their neighbours count alike, m.
  double spacing = 0.04;
  SurfaceOptions surface;
  MatchingMethod method = MatchingMethod::point_to_line;
  ScanMatcherOptions matcher;
};

/// What a scan has told.
struct FrontEndStep {
  std::int64_t time = 0;
  /// Of the robot, in the front end's own frame.
  Pose2 local_pose;
  PoseCovariance covariance;
  /// How many of the scan's points are on known surfaces, from 0 to 1.
  double matched = 0;
  LocalisationState state = LocalisationState::tracking;
  /// For people, where the state is not tracking.
  std::string reason;
  /// The newest keyframe, and the robot's pose on it.
  std::int64_t keyframe = 0;
  Pose2 on_keyframe;
  /// The keyframe, if this scan became one, and how it follows from the one before.
  std::optional<Keyframe> new_keyframe;
  std::optional<Constraint> constraint;
};

/// Where the robot is, scan by scan, by the newest keyframes: consistent over some metres, with
/// drift that grows with the way. Without threads and clocks.
class FrontEnd {
public:
  explicit FrontEnd(const FrontEndOptions& options = {});

  /// Goes on from keyframes that another front end has made, the newest of the path in order. The
  /// next scan is looked for around the last of them.
  void resume(const std::vector<Keyframe>& newest);

  /// The next scan, with the robot's odometry at its time.
  FrontEndStep add(const LaserScan& scan, const Pose2& odometry);

private:
  struct Motion {
    /// By odometry.
    Pose2 step;
    /// If the robot goes on as it did; nothing after a gap.
    std::optional<Pose2> as_before;
    PosePrior prior;
    /// Its size is not known well: there was a gap, or odometry has jumped.
    bool is_uncertain = false;
    std::string reason;
  };

  struct Aligned {
    SurfacePoints points;
    ScanMatch match;
  };

  struct Found {
    ScanMatch match;
    bool fits = false;
  };

  Motion motion_to(std::int64_t time, const Pose2& odometry) const;
  Found find(const LaserScan& scan, const SurfacePoints& points, const Motion& motion) const;
  /// The scan without narrow things, which may walk, if the match of all of it is doubtful and they
  /// have drawn it away from the wheels.
  std::optional<Aligned> without_narrow(const LaserScan& scan, const ScanMatch& all,
                                        const Motion& motion) const;
  /// Lets the wheels count in the direction in which few points tell where the robot is, if the
  /// match is too far from them there.
  void keep_to_wheels(ScanMatch& match, const Motion& motion) const;
  /// Those of a robot at that pose that have not moved; all if that is too much of them.
  SurfacePoints standing_of(const SurfacePoints& points, const Pose2& pose) const;
  ScanMatch match_near(const SurfacePoints& scan, const Motion& motion) const;
  bool is_far_from_keyframe(const Pose2& pose) const;
  void make_keyframe(FrontEndStep& step, const LaserScan& scan, const Pose2& odometry,
                     const SurfacePoints& points);
  Constraint constraint_to(const FrontEndStep& step) const;
  void place(const Keyframe& keyframe, const SurfacePoints& points);

  FrontEndOptions options_;
  std::unique_ptr<const PointMatcher> matcher_;
  std::optional<Keyframe> newest_;
  LocalMap map_;
  std::int64_t time_ = 0;
  Pose2 odometry_;
  Pose2 pose_;
  /// Movement of the robot from one scan to the next, as a step and its time, us.
  Pose2 last_step_;
  std::int64_t last_duration_ = 0;
  bool has_resumed_ = false;
};

CASTOR_REFLECT_ENUM(MatchingMethod, point_to_line, icp)

} // namespace castor::mapping
