#pragma once

#include "castor/mapping/map_components/types.hpp"
#include "castor/mapping/planar/odometry_history.hpp"
#include "castor/mapping/planar/types.hpp"

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace castor::mapping {

/// The poses of keyframes beside the true ones, which only a simulator knows. Both are in one
/// frame.
class PathComparison {
public:
  /// Where the robot truly was, in the order of time.
  void add_truth(std::int64_t time, const Pose2& pose);

  /// True poses that an evaluator before this one knew, for keyframes of these times.
  void add_truths(const TruePath& known);

  /// A keyframe is new, or its pose has been corrected.
  /// @param time of its scan; its true pose is looked up once there are truths of before and after
  void place(const std::string& keyframe, std::int64_t time, const Pose2& pose);

  void remove(const std::string& keyframe);

  /// Of the keyframes whose true pose is known; all zero without one. Collisions and the like are
  /// not filled in.
  PathError error() const;

  /// True poses of these keyframes, in the order of time.
  TruePath truth() const;

private:
  struct Place {
    std::int64_t time = 0;
    Pose2 pose;
    std::optional<Pose2> truth;
  };

  void look_up(const std::string& keyframe);

  OdometryHistory truths_;
  /// Those of an evaluator before this one, by the time of the keyframe.
  std::map<std::int64_t, Pose2> former_truths_;
  std::map<std::string, Place> places_;
  /// Keyframes that are newer than all truths.
  std::set<std::string> waiting_;
};

} // namespace castor::mapping
