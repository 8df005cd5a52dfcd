#pragma once

#include "castor/actors/component/option.hpp"
#include "castor/actors/component/subarchitecture_component.hpp"
#include "castor/mapping/geometry/types.hpp"
#include "castor/mapping/planar/odometry_frame.hpp"
#include "castor/mapping/planar/poses.hpp"
#include "castor/mapping/planar/scan_queue.hpp"
#include "castor/mapping/slam/pose_news.hpp"
#include "castor/mapping/slam/types.hpp"

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>

namespace castor::mapping {

/// A component that finds out where a robot is, scan by scan: takes scans with the odometry of
/// their times, and keeps one RobotPose and the Transform of the odometry frame up to date. While
/// the robot stands, they are not overwritten; when no scan comes, the wheels alone say where it
/// is.
class FollowsScans : public UnmanagedComponent {
protected:
  /// The next scan, with the robot's odometry at its time. To be followed by tell().
  virtual void process(const LaserScan& scan, const Pose2& odometry) = 0;

  /// Where the robot is without scans: state, pose and covariance.
  /// @param moved since the last scan, by the wheels
  /// @param drift of that, square metres and square radians
  virtual RobotPose without_scans(const Pose2& moved, double drift) const = 0;

  /// To be called in `configure()`.
  void configure_news(PoseNewsOptions options = {}) {
    options.period = std::chrono::microseconds{period_.get()}.count();
    news_ = PoseNews{options};
  }

  /// To be called in `start()`.
  void follow_scans() {
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

  /// Scans up to that time are old.
  void begin_after(std::int64_t time, const Pose2& odometry) {
    time_ = time;
    last_odometry_ = odometry;
  }

  /// The robot's pose by the last scan. Writes it if it is news; `has_frame`: it is known where the
  /// odometry frame is, too.
  void tell(RobotPose x, bool has_frame = true) {
    x.time = time_;
    if (put_if_news(x, last_odometry_) && has_frame)
      put(here("odometry-frame"), odometry_in_map(x.pose, last_odometry_, x.time));
  }

  bool has_seen_scan() const { return last_scan_ != Timestamp{}; }

private:
  void process_waiting() {
    while (auto x = scans_.next()) {
      if (x->scan->time <= time_)
        continue;
      begin_after(x->scan->time, x->odometry);
      last_scan_ = now();
      process(*x->scan, x->odometry);
    }
  }

  void check_silence() {
    if (now() - last_scan_ < silence_.get())
      return;
    const auto newest = scans_.newest_odometry();
    const auto odometry = newest ? newest->pose : last_odometry_;
    const auto moved = between(last_odometry_, odometry);
    const auto way = distance(Pose2{}, moved);
    constexpr double drift = 0.01; // m2 for a m2
    auto x = without_scans(moved, drift * way * way);
    x.time = newest ? newest->time : time_;
    x.reason = scans_.empty() ? "no scan comes from " + laser_.get()
                              : "no odometry comes from " + odometry_.get();
    if (x.reason != silence_told_of_ && (has_seen_scan() || x.state != LocalisationState::starting))
      warning("{}", x.reason);
    silence_told_of_ = x.reason;
    put_if_news(x, odometry);
  }

  bool put_if_news(RobotPose& x, const Pose2& odometry) {
    x.frame = geometry::map_frame;
    if (!news_.is_news(x, odometry))
      return false;
    news_.told(x, odometry);
    put(here("robot-pose"), x);
    return true;
  }

  Option<StandaloneName> laser_{this, "laser", "robot", "the component that pushes LaserScan"};
  Option<StandaloneName> odometry_{this, "odometry", "robot", "the component that pushes Odometry"};
  Option<std::chrono::milliseconds> period_{this, "period", std::chrono::milliseconds{100},
                                            "shortest time from one pose to the next"};
  Option<std::chrono::milliseconds> silence_{
    this, "silence", std::chrono::seconds{1},
    "time without scans after which only the wheels count"};

  PoseNews news_;
  ScanQueue scans_;
  /// Of the last scan.
  std::int64_t time_ = 0;
  Pose2 last_odometry_;
  Timestamp last_scan_{};
  std::string silence_told_of_;
};

} // namespace castor::mapping
