#pragma once

#include "castor/mapping/graph/door_detector.hpp"
#include "castor/mapping/graph/segments.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <vector>

namespace castor::mapping {

struct GatewayOptions {
  /// Two openings are of one gateway if they are at most this far apart, metres, and differ in
  /// direction by at most this, radians.
  double near = 0.5;
  double turned = 0.6;
  /// Views that confirm a gateway, from places that are at least `apart` metres from one another.
  int views = 3;
  double apart = 0.1;
  /// A gateway is one as long as this share of the views in which it should have been seen show it.
  double least_share = 0.3;
  /// The same for one that another source says is none.
  double least_share_if_doubted = 0.7;
  /// A gateway should be seen up to here, metres, if the angle between the way through and the line
  /// of sight is at most `slant`, radians.
  double sight = 3;
  double slant = 0.8;
  /// Views that are kept of each gateway, those from nearby.
  std::size_t most_views = 24;
};

/// A gateway by all its views.
struct Gateway {
  std::int64_t id = 0;
  /// The middle, facing the way through in one of the two directions.
  Pose2 pose;
  double width = 0;
  bool is_confirmed = false;
  /// Another source says that it is none.
  bool is_doubted = false;
  /// The keyframe that it was seen best from.
  std::int64_t keyframe = 0;

  /// From post to post.
  Line2 line() const;
};

/// Collects the openings that single scans show into gateways, which several views confirm, and
/// views that should have shown them and did not refute. Views belong to keyframes, and follow
/// corrections of these.
class GatewayTracker {
public:
  /// Pose of the robot at the keyframe with that number.
  using PoseOf = std::function<Pose2(std::int64_t)>;

  explicit GatewayTracker(const GatewayOptions& options = {}) : options_(options) {}

  /// A keyframe shows these openings, and no others.
  void add(std::int64_t keyframe, const Pose2& robot, const LaserScan& scan,
           const std::vector<Opening>& openings);

  /// Whether two openings are one: at one place, and facing the same or opposite directions.
  bool is_same(const Pose2& a, const Pose2& b) const;

  /// Another source, such as a room segmentation, says whether that gateway is one: then one view
  /// is enough, or most of the possible views are needed. Nothing, if it does not say.
  void support(std::int64_t gateway, std::optional<bool> is_gateway);

  /// The views of that keyframe count no more.
  void remove(std::int64_t keyframe, const PoseOf& pose_of);

  /// Poses of keyframes were corrected. Gateways that are at one place now are one, with the lowest
  /// id of them.
  void correct(const PoseOf& pose_of);

  const std::map<std::int64_t, Gateway>& gateways() const { return gateways_; }

private:
  struct View {
    std::int64_t keyframe = 0;
    /// The opening on the robot.
    Pose2 on_robot;
    double width = 0;
    /// Of the robot in the map.
    Pose2 robot;
    double weight = 0;
  };

  struct Evidence {
    std::vector<View> views;
    /// Views from places that are apart, and views that should have shown it.
    int hits = 0;
    int misses = 0;
    std::optional<bool> support;
    Point2 last_hit_from;
    Point2 last_miss_from;
  };

  void count_hit(Evidence& x, const Pose2& robot) const;
  void count_miss(Evidence& x, const Gateway& gateway, const Pose2& robot,
                  const LaserScan& scan) const;
  void summarise(std::int64_t id);
  void merge_those_at_one_place();

  GatewayOptions options_;
  std::map<std::int64_t, Evidence> evidence_;
  std::map<std::int64_t, Gateway> gateways_;
  std::int64_t next_id_ = 0;
};

} // namespace castor::mapping
