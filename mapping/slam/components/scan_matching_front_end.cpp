#include "castor/actors/component/registry.hpp"
#include "castor/mapping/planar/poses.hpp"
#include "castor/mapping/slam/components/follows_scans.hpp"
#include "castor/mapping/slam/front_end.hpp"
#include "castor/mapping/slam/map_frame.hpp"
#include "castor/mapping/slam/types.hpp"
#include "castor/wm/entries/failure.hpp"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace castor::mapping {

namespace {

/// Follows the robot from scan to scan. Adds a keyframe and its constraint each time that the robot
/// has moved, and keeps one RobotPose and the Transform of the odometry frame up to date: while the
/// robot stands, they are not overwritten. One that is started again goes on from the newest
/// keyframes.
class ScanMatchingFrontEnd final : public FollowsScans {
  void configure() override {
    FrontEndOptions options;
    options.keyframe_distance = keyframe_distance_;
    options.keyframe_turn = keyframe_turn_;
    options.surface.max_range = max_range_;
    options.method = method_;
    front_end_ = std::make_unique<FrontEnd>(options);
    PoseNewsOptions news;
    news.tolerance = tolerance_;
    news.tolerance_heading = tolerance_heading_;
    configure_news(news);
    keyframe_count_ = options.map.keyframes;
  }

  void start() override {
    resume();
    on_change(changed<GraphPoses>().in(subarchitecture()),
              [this](const ChangeEvent& event) { look_at_graph(event.address); });
    for (auto& x : read_all<GraphPoses>())
      take_graph(*x);
    follow_scans();
  }

  void resume() {
    auto newest = read_all<Keyframe>(keyframe_count_);
    std::vector<Keyframe> path;
    for (auto& x : newest)
      path.push_back(*x);
    std::sort(path.begin(), path.end(),
              [](const Keyframe& a, const Keyframe& b) { return a.number < b.number; });
    if (path.empty())
      return;
    info("goes on from keyframe {}", path.back().number);
    front_end_->resume(path);
    last_.local_pose = path.back().local_pose;
    is_resumed_ = true;
    begin_after(path.back().time, path.back().odometry);
  }

  /// A correction of the whole path moves the robot, too: from its next scan on.
  void look_at_graph(const Address& address) {
    try {
      take_graph(*read<GraphPoses>(address));
    } catch (const DoesNotExistOnWM&) {
      debug("the poses were deleted before they were read");
    }
  }

  void take_graph(const GraphPoses& x) { local_frame_ = x.local_frame; }

  void process(const LaserScan& scan, const Pose2& odometry) override {
    auto before = last_.state;
    last_ = front_end_->add(scan, odometry);
    if (last_.state != before && last_.state == LocalisationState::dead_reckoning)
      warning("{}", last_.reason);
    if (last_.new_keyframe)
      add_keyframe();
    tell_pose();
  }

  void add_keyframe() {
    WriteBatch batch;
    auto number = std::to_string(last_.new_keyframe->number);
    batch.add(here("keyframe-" + number), std::move(*last_.new_keyframe));
    if (last_.constraint)
      batch.add(here("constraint-" + number), *last_.constraint);
    last_.new_keyframe.reset();
    write(batch);
  }

  void tell_pose() {
    RobotPose x;
    x.pose = compose(local_frame_, last_.local_pose);
    x.covariance = turned(last_.covariance, local_frame_.heading);
    x.state = last_.state;
    x.reason = last_.reason;
    tell(x);
  }

  RobotPose without_scans(const Pose2& moved, double drift) const override {
    RobotPose x;
    x.pose = compose(compose(local_frame_, last_.local_pose), moved);
    x.covariance.xx = x.covariance.yy = x.covariance.heading = 1e-4 + drift;
    x.state = has_seen_scan() || is_resumed_ ? LocalisationState::dead_reckoning
                                             : LocalisationState::starting;
    return x;
  }

  Option<double> keyframe_distance_{this, "keyframe-distance", FrontEndOptions{}.keyframe_distance,
                                    "way from keyframe to keyframe, metres"};
  Option<double> keyframe_turn_{this, "keyframe-turn", FrontEndOptions{}.keyframe_turn,
                                "or turn, radians"};
  Option<double> max_range_{this, "max-range", SurfaceOptions{}.max_range,
                            "beams that end further away are left out, metres"};
  Option<MatchingMethod> method_{this, "matcher", MatchingMethod::point_to_line,
                                 "metric by which scans are aligned; icp (point to point, of MRPT) "
                                 "is a baseline"};
  Option<double> tolerance_{this, "tolerance", PoseNewsOptions{}.tolerance,
                            "while the robot stands, another pose is told if it is so far from "
                            "the last, metres"};
  Option<double> tolerance_heading_{this, "tolerance-heading", PoseNewsOptions{}.tolerance_heading,
                                    "or turned by so much, radians"};
  std::unique_ptr<FrontEnd> front_end_;
  std::size_t keyframe_count_ = 0;
  FrontEndStep last_;
  /// Keyframes were there when it began.
  bool is_resumed_ = false;
  Pose2 local_frame_;
};

CASTOR_COMPONENT(ScanMatchingFrontEnd,
                 "follows a robot by its laser, and makes keyframes of its path")

} // namespace

} // namespace castor::mapping
