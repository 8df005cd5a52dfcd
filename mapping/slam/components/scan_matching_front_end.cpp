#include "castor/actors/component/registry.hpp"
#include "castor/mapping/geometry/types.hpp"
#include "castor/mapping/planar/odometry_frame.hpp"
#include "castor/mapping/planar/poses.hpp"
#include "castor/mapping/planar/scan_queue.hpp"
#include "castor/mapping/slam/front_end.hpp"
#include "castor/mapping/slam/map_frame.hpp"
#include "castor/mapping/slam/pose_news.hpp"
#include "castor/mapping/slam/types.hpp"
#include "castor/wm/entries/failure.hpp"

#include <algorithm>
#include <chrono>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace castor::mapping {

namespace {

using namespace std::chrono_literals;

/// Follows the robot from scan to scan. Adds a keyframe and its constraint each time that the robot
/// has moved, and keeps one RobotPose and the Transform of the odometry frame up to date: while the
/// robot stands, they are not overwritten. One that is started again goes on from the newest
/// keyframes.
class ScanMatchingFrontEnd final : public UnmanagedComponent {
  void configure() override {
    FrontEndOptions options;
    options.keyframe_distance = keyframe_distance_;
    options.keyframe_turn = keyframe_turn_;
    options.surface.max_range = max_range_;
    options.method = method_;
    front_end_ = std::make_unique<FrontEnd>(options);
    PoseNewsOptions news;
    news.period = std::chrono::microseconds{period_.get()}.count();
    news.tolerance = tolerance_;
    news.tolerance_heading = tolerance_heading_;
    news_ = PoseNews{news};
    keyframe_count_ = options.keyframes;
  }

  void start() override {
    resume();
    on_change(changed<GraphPoses>().in(subarchitecture()),
              [this](const ChangeEvent& event) { look_at_graph(event.address); });
    for (auto& x : read_all<GraphPoses>())
      take_graph(*x);
    on_push<Odometry>(odometry_.get(), [this](const std::shared_ptr<const Odometry>& x) {
      scans_.add(*x);
      process_waiting();
    });
    on_push<LaserScan>(laser_.get(), [this](const std::shared_ptr<const LaserScan>& x) {
      scans_.add(x);
      process_waiting();
    });
    every(silence_.get(), [this] { check_silence(); });
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
    last_odometry_ = path.back().odometry;
    last_.time = path.back().time;
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

  void process_waiting() {
    while (auto x = scans_.next())
      if (x->scan->time > last_.time)
        process(*x->scan, x->odometry);
  }

  void process(const LaserScan& scan, const Pose2& odometry) {
    auto before = last_.state;
    last_ = front_end_->add(scan, odometry);
    last_odometry_ = odometry;
    last_scan_ = now();
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
    x.time = last_.time;
    x.frame = geometry::map_frame;
    x.pose = compose(local_frame_, last_.local_pose);
    x.covariance = turned(last_.covariance, local_frame_.heading);
    x.state = last_.state;
    x.reason = last_.reason;
    if (!news_.is_news(x, last_odometry_))
      return;
    news_.told(x, last_odometry_);
    put(here("robot-pose"), x);
    put(here("odometry-frame"), odometry_in_map(x.pose, last_odometry_, x.time));
  }

  /// A laser that has stopped: the wheels alone say where the robot is.
  void check_silence() {
    if (now() - last_scan_ < silence_.get())
      return;
    auto newest = scans_.newest_odometry();
    RobotPose x;
    x.frame = geometry::map_frame;
    x.time = newest ? newest->time : last_.time;
    auto on_last = newest ? between(last_odometry_, newest->pose) : Pose2{};
    auto way = distance(Pose2{}, on_last);
    x.pose = compose(compose(local_frame_, last_.local_pose), on_last);
    x.covariance.xx = x.covariance.yy = 1e-4 + 0.01 * way * way;
    x.covariance.heading = 1e-4 + 0.01 * way * way;
    auto has_been_seen = last_scan_ != Timestamp{} || last_.time > 0;
    x.state = has_been_seen ? LocalisationState::dead_reckoning : LocalisationState::starting;
    x.reason = scans_.empty() ? "no scan comes from " + laser_.get()
                              : "no odometry comes from " + odometry_.get();
    if (x.reason != silence_told_of_ && has_been_seen)
      warning("{}", x.reason);
    silence_told_of_ = x.reason;
    auto odometry = newest ? newest->pose : last_odometry_;
    if (!news_.is_news(x, odometry))
      return;
    news_.told(x, odometry);
    put(here("robot-pose"), x);
  }

  Option<StandaloneName> laser_{this, "laser", "robot", "the component that pushes LaserScan"};
  Option<StandaloneName> odometry_{this, "odometry", "robot", "the component that pushes Odometry"};
  Option<double> keyframe_distance_{this, "keyframe-distance", FrontEndOptions{}.keyframe_distance,
                                    "way from keyframe to keyframe, metres"};
  Option<double> keyframe_turn_{this, "keyframe-turn", FrontEndOptions{}.keyframe_turn,
                                "or turn, radians"};
  Option<double> max_range_{this, "max-range", SurfaceOptions{}.max_range,
                            "beams that end further away are left out, metres"};
  Option<MatchingMethod> method_{this, "matcher", MatchingMethod::point_to_line,
                                 "metric by which scans are aligned; icp (point to point, of MRPT) "
                                 "is a baseline"};
  Option<std::chrono::milliseconds> period_{this, "period", 100ms,
                                            "shortest time from one pose to the next"};
  Option<double> tolerance_{this, "tolerance", PoseNewsOptions{}.tolerance,
                            "while the robot stands, another pose is told if it is so far from "
                            "the last, metres"};
  Option<double> tolerance_heading_{this, "tolerance-heading", PoseNewsOptions{}.tolerance_heading,
                                    "or turned by so much, radians"};
  Option<std::chrono::milliseconds> silence_{
    this, "silence", 1000ms, "time without scans after which only the wheels count"};

  std::unique_ptr<FrontEnd> front_end_;
  std::size_t keyframe_count_ = 0;
  PoseNews news_;
  ScanQueue scans_;
  FrontEndStep last_;
  Pose2 last_odometry_;
  Pose2 local_frame_;
  Timestamp last_scan_{};
  std::string silence_told_of_;
};

CASTOR_COMPONENT(ScanMatchingFrontEnd,
                 "follows a robot by its laser, and makes keyframes of its path")

} // namespace

} // namespace castor::mapping
