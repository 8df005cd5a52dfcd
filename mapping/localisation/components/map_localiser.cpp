#include "castor/actors/component/registry.hpp"
#include "castor/base/named_file.hpp"
#include "castor/base/text_file.hpp"
#include "castor/mapping/geometry/poses.hpp"
#include "castor/mapping/localisation/monte_carlo_localiser.hpp"
#include "castor/mapping/maps/map_server.hpp"
#include "castor/mapping/planar/odometry_frame.hpp"
#include "castor/mapping/planar/poses.hpp"
#include "castor/mapping/planar/scan_queue.hpp"
#include "castor/mapping/slam/pose_news.hpp"
#include "castor/mapping/slam/types.hpp"

#include <chrono>
#include <cstdint>
#include <memory>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace castor::mapping {

namespace {

using namespace std::chrono_literals;

/// The pose written as X,Y,DEGREES; nothing for "unknown".
std::optional<Pose2> start_named(const std::string& text) {
  if (text == "unknown")
    return {};
  std::vector<double> numbers;
  for (std::size_t begin = 0; begin <= text.size();) {
    auto end = std::min(text.find(',', begin), text.size());
    auto number = parse_number(text.substr(begin, end - begin));
    if (!number)
      break;
    numbers.push_back(*number);
    begin = end + 1;
    if (end == text.size() && numbers.size() == 3)
      return Pose2{numbers[0], numbers[1], normalised(numbers[2] * std::numbers::pi / 180)};
  }
  throw std::invalid_argument("--start: '" + text +
                              "' is no pose; write X,Y,HEADING in metres and degrees, for example "
                              "2.5,5.1,90, or unknown");
}

/// Says where the robot is in a map of ROS's map_server: keeps one RobotPose and the Transform of
/// the odometry frame up to date, as ScanMatchingFrontEnd does.
class MapLocaliser final : public UnmanagedComponent {
  void configure() override {
    if (map_file_->empty())
      throw std::invalid_argument("--map is not set: name the .yaml of a map, for example one that "
                                  "`castor map export` has written");
    start_ = start_named(start_text_);
    map_ = read_map_server(file_named(map_file_, base_.get()));
    localiser_ = std::make_unique<MonteCarloLocaliser>(map_, start_, localiser_options());
    PoseNewsOptions news;
    news.period = std::chrono::microseconds{period_.get()}.count();
    news_ = PoseNews{news};
  }

  MonteCarloOptions localiser_options() const {
    MonteCarloOptions result;
    result.filter.seed = static_cast<std::uint64_t>(seed_.get());
    result.filter.beams = beams_;
    result.filter.most_particles = most_particles_;
    result.monitor.least_explained = least_explained_;
    result.monitor.lost_after = std::chrono::duration<double>(lost_after_.get()).count();
    return result;
  }

  void start() override {
    // One before, which has failed, knew where the odometry frame is.
    for (auto& x : read_all<RobotPose>())
      if (x->state == LocalisationState::tracking)
        for (auto& frame : read_all<geometry::Transform>())
          if (frame->frame == geometry::odometry_frame)
            frame_before_ = floor_pose(*frame);
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

  void process_waiting() {
    while (auto x = scans_.next())
      if (x->scan->time > last_.time)
        process(*x->scan, x->odometry);
  }

  void process(const LaserScan& scan, const Pose2& odometry) {
    if (frame_before_) {
      info("goes on where it was");
      localiser_ = std::make_unique<MonteCarloLocaliser>(map_, compose(*frame_before_, odometry),
                                                         localiser_options());
      frame_before_.reset();
    }
    auto before = last_.state;
    last_ = localiser_->add(scan, odometry);
    last_odometry_ = odometry;
    last_scan_ = now();
    auto is_new = last_.state != before;
    if (is_new && last_.state == LocalisationState::tracking)
      info("{}", last_.reason.empty() ? "tracking again" : last_.reason);
    else if (is_new)
      warning("{}", last_.reason);
    tell_pose();
  }

  void tell_pose() {
    RobotPose x;
    x.time = last_.time;
    x.frame = geometry::map_frame;
    x.pose = last_.pose;
    x.covariance = last_.covariance;
    x.state = last_.state;
    x.reason = last_.reason;
    if (!news_.is_news(x, last_odometry_))
      return;
    news_.told(x, last_odometry_);
    put(here("robot-pose"), x);
    // Before it is known, there is no such frame; while the robot is lost, the last one is kept.
    if (x.state == LocalisationState::tracking || x.state == LocalisationState::dead_reckoning)
      put(here("odometry-frame"), odometry_in_map(x.pose, last_odometry_, x.time));
  }

  /// A laser that has stopped: the wheels alone say where the robot is.
  void check_silence() {
    if (now() - last_scan_ < silence_.get())
      return;
    auto reason = scans_.empty() ? "no scan comes from " + laser_.get()
                                 : "no odometry comes from " + odometry_.get();
    if (reason != silence_told_of_ && last_scan_ != Timestamp{})
      warning("{}", reason);
    silence_told_of_ = reason;
    RobotPose x;
    auto newest = scans_.newest_odometry();
    x.time = newest ? newest->time : last_.time;
    x.frame = geometry::map_frame;
    auto moved = newest ? between(last_odometry_, newest->pose) : Pose2{};
    x.pose = compose(last_.pose, moved);
    x.covariance = last_.covariance;
    auto way = distance(Pose2{}, moved);
    constexpr double drift = 0.01; // m2 for a m2, as the front end has it
    x.covariance.xx += drift * way * way;
    x.covariance.yy += drift * way * way;
    x.covariance.heading += drift * way * way;
    x.state =
      last_.state == LocalisationState::tracking ? LocalisationState::dead_reckoning : last_.state;
    x.reason = reason;
    auto odometry = newest ? newest->pose : last_odometry_;
    if (!news_.is_news(x, odometry))
      return;
    news_.told(x, odometry);
    put(here("robot-pose"), x);
  }

  Option<std::string> map_file_{this, "map", "", ".yaml of a map of ROS's map_server"};
  Option<std::string> start_text_{this, "start", "unknown",
                                  "where the robot begins: X,Y,HEADING (metres, degrees), or "
                                  "unknown"};
  Option<std::string> base_{this, "base", "", "folder in which a relative file is looked for too"};
  Option<StandaloneName> laser_{this, "laser", "robot", "the component that pushes LaserScan"};
  Option<StandaloneName> odometry_{this, "odometry", "robot", "the component that pushes Odometry"};
  Option<std::int64_t> seed_{this, "seed", 1, "of the particles"};
  Option<std::size_t> beams_{this, "beams", ParticleFilterOptions{}.beams,
                             "beams of a scan that particles are weighted by"};
  Option<unsigned> most_particles_{this, "most-particles", ParticleFilterOptions{}.most_particles,
                                   "when the robot may be anywhere"};
  Option<double> least_explained_{this, "least-explained",
                                  LocalisationMonitorOptions{}.least_explained,
                                  "a scan of which the map explains a smaller share does not fit"};
  Option<std::chrono::milliseconds> lost_after_{
    this, "lost-after", 1000ms, "the robot is lost if no scan has fitted for so long"};
  Option<std::chrono::milliseconds> period_{this, "period", 100ms,
                                            "shortest time from one pose to the next"};
  Option<std::chrono::milliseconds> silence_{
    this, "silence", 1000ms, "time without scans after which only the wheels count"};

  std::optional<Pose2> start_;
  CellMap map_;
  std::unique_ptr<MonteCarloLocaliser> localiser_;
  /// Of the odometry in the map, by a localiser before this one.
  std::optional<Pose2> frame_before_;
  PoseNews news_;
  ScanQueue scans_;
  LocalisationStep last_;
  Pose2 last_odometry_;
  Timestamp last_scan_{};
  std::string silence_told_of_;
};

CASTOR_COMPONENT(MapLocaliser, "says where a robot is in a given map, by its laser")

} // namespace

} // namespace castor::mapping
