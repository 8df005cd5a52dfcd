#include "castor/actors/component/registry.hpp"
#include "castor/base/named_file.hpp"
#include "castor/base/text_file.hpp"
#include "castor/mapping/geometry/poses.hpp"
#include "castor/mapping/localisation/monte_carlo_localiser.hpp"
#include "castor/mapping/maps/map_server.hpp"
#include "castor/mapping/planar/odometry_frame.hpp"
#include "castor/mapping/planar/poses.hpp"
#include "castor/mapping/slam/components/follows_scans.hpp"
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
class MapLocaliser final : public FollowsScans {
  void configure() override {
    if (map_file_->empty())
      throw std::invalid_argument("--map is not set: name the .yaml of a map, for example one that "
                                  "`castor map export` has written");
    start_ = start_named(start_text_);
    map_ = read_map_server(file_named(map_file_, base_.get()));
    localiser_ = std::make_unique<MonteCarloLocaliser>(map_, start_, localiser_options());
    configure_news();
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
    follow_scans();
  }

  void process(const LaserScan& scan, const Pose2& odometry) override {
    if (frame_before_) {
      info("goes on where it was");
      localiser_ = std::make_unique<MonteCarloLocaliser>(map_, compose(*frame_before_, odometry),
                                                         localiser_options());
      frame_before_.reset();
    }
    auto before = last_.state;
    last_ = localiser_->add(scan, odometry);
    auto is_new = last_.state != before;
    if (is_new && last_.state == LocalisationState::tracking)
      info("{}", last_.reason.empty() ? "tracking again" : last_.reason);
    else if (is_new)
      warning("{}", last_.reason);
    tell_pose();
  }

  void tell_pose() {
    RobotPose x;
    x.pose = last_.pose;
    x.covariance = last_.covariance;
    x.state = last_.state;
    x.reason = last_.reason;
    // Before it is known, there is no such frame; while the robot is lost, the last one is kept.
    tell(x, x.state == LocalisationState::tracking || x.state == LocalisationState::dead_reckoning);
  }

  RobotPose without_scans(const Pose2& moved, double drift) const override {
    RobotPose x;
    x.pose = compose(last_.pose, moved);
    x.covariance = last_.covariance;
    x.covariance.xx += drift;
    x.covariance.yy += drift;
    x.covariance.heading += drift;
    x.state =
      last_.state == LocalisationState::tracking ? LocalisationState::dead_reckoning : last_.state;
    return x;
  }

  Option<std::string> map_file_{this, "map", "", ".yaml of a map of ROS's map_server"};
  Option<std::string> start_text_{this, "start", "unknown",
                                  "where the robot begins: X,Y,HEADING (metres, degrees), or "
                                  "unknown"};
  Option<std::string> base_{this, "base", "", "folder in which a relative file is looked for too"};
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

  std::optional<Pose2> start_;
  CellMap map_;
  std::unique_ptr<MonteCarloLocaliser> localiser_;
  /// Of the odometry in the map, by a localiser before this one.
  std::optional<Pose2> frame_before_;
  LocalisationStep last_;
};

CASTOR_COMPONENT(MapLocaliser, "says where a robot is in a given map, by its laser")

} // namespace

} // namespace castor::mapping
