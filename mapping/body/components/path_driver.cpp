#include "castor/actors/component/registry.hpp"
#include "castor/base/named_file.hpp"
#include "castor/base/text_file.hpp"
#include "castor/mapping/body/components/drives_by_pose.hpp"
#include "castor/mapping/body/free_way.hpp"
#include "castor/mapping/body/path_follower.hpp"
#include "castor/mapping/body/seen_obstacles.hpp"
#include "castor/mapping/body/stall_recovery.hpp"
#include "castor/mapping/planar/braking.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

namespace castor::mapping {

namespace {

using namespace std::chrono_literals;

enum class AfterArrival { stay, end };
CASTOR_REFLECT_ENUM(AfterArrival, stay, end)

/// Drives a robot along a given path. Where something reaches into its way, it steers aside a
/// little, by --aside at most; otherwise it waits. After --back-off it goes back a little the way
/// it came, so that a localisation that was wrong gets other scans, and comes again, --recoveries
/// times at most; after --patience it says that somebody has to clear the way, and begins anew.
class PathDriver final : public DrivesByPose {
public:
  PathDriver() : DrivesByPose(PoseSource::odometry) {
    // nop
  }

private:
  void configure() override {
    PathText read;
    if (!file_->empty()) {
      const auto file = file_named(file_, base_.get());
      read = parse_path(load_text(file), file.string());
    } else {
      read = parse_path(path_.get(), "--path");
    }
    if (has_errors(read.problems))
      throw TextFileError(read.problems);
    way_ = std::move(read.path);
    StallOptions stall;
    stall.patience = std::chrono::duration_cast<Timestamp>(back_off_.get()).count();
    stall.way_back = back_off_way_;
    recovery_ = StallRecovery(stall);
    begin_round();
  }

  void start() override {
    follow_pose();
    if (stop_before_ > 0)
      on_push<LaserScan>(sensors(), [this](auto& x) { look(*x); });
  }

  void look(const LaserScan& scan) {
    free_way_ = free_way(scan, half_width_);
    if (pose())
      seen_.add(scan, *pose());
  }

  void run() override {
    // The front of the path may have been driven by one before, which has failed.
    if (const auto before = progress_before()) {
      rounds_ = before->arrived ? rounds_to_drive_.get() : before->rounds;
      follower_->resume(before->done);
    }
    take_seat();
    tell("begins");
    while (rounds_ < rounds_to_drive_ && sleep_for(period_.get()))
      drive_on();
    drive({});
    leave_seat();
    tell({});
    if (!is_running())
      return;
    info("has arrived, {} of {} rounds", rounds_, rounds_to_drive_.get());
    if (after_arrival_ == AfterArrival::end)
      end_system(0, "the path was driven");
  }

  void drive_on() {
    if (!pose()) {
      wait("a pose");
      return;
    }
    auto velocity = follower_->velocity_at(*pose(), shift());
    if (follower_->has_arrived()) {
      ++rounds_;
      begin_round();
      tell({});
      return;
    }
    if (is_lost()) {
      wait("localisation");
      return;
    }
    if (recovery_.is_active()) {
      go_back();
      return;
    }
    const bool is_free = is_slowed_to_way(velocity);
    if (recovery_.has_stalled(now().count(), *pose(), backs_off()) &&
        recovery_.begin(now().count(), *pose())) {
      ++recoveries_;
      way_ended_.reset();
      info("goes back a little: it does not come further at {:.2f} {:.2f}", pose()->x, pose()->y);
      go_back();
    } else if (!is_free) {
      wait_for_way();
    } else {
      way_ended_.reset();
      drive(velocity);
      if (!waits_for_.empty() || now() - told_ >= 1s)
        tell({});
    }
  }

  /// Of the path, so that the robot passes what reaches into it.
  double shift() const {
    if (!(aside_ > 0) || !(stop_before_ > 0))
      return 0;
    constexpr double way = 1.2; // metres
    // More than what it stops for: on a shifted path that leaves just that, it would stand.
    constexpr double room = 0.05; // metres
    const auto seen = seen_.points();
    for (const double more : {room, 0.0})
      if (const auto x = follower_->free_shift(seen, half_width_ + more, way, aside_))
        return *x;
    return 0;
  }

  /// Whether it may go back from where it is stuck: so often at most since it came further.
  bool backs_off() {
    constexpr double further = 1; // metres
    if (follower_->done() > recovered_at_ + further) {
      recovered_at_ = follower_->done();
      recoveries_ = 0;
    }
    return back_off_.get() > 0s && recoveries_ < most_recoveries_;
  }

  void go_back() {
    auto velocity = recovery_.velocity(now().count(), *pose());
    if (!velocity) {
      drive({});
      // Where the path is now nearest.
      follower_->resume(std::max(0.0, follower_->done() - 2 * back_off_way_));
      tell({});
      return;
    }
    if (!is_slowed_to_way(*velocity))
      velocity = Twist2{};
    drive(*velocity);
    if (waits_for_ != "another way to the place")
      tell("another way to the place");
  }

  /// Slows down so that the robot can stop before what is in its way; false if it has to stand.
  bool is_slowed_to_way(Twist2& velocity) const {
    if (!(velocity.forward > 0) || !(stop_before_ > 0))
      return true;
    const double fastest = speed_to_stop_within(free_way_ - stop_before_, 0, braking_);
    constexpr double slowest = 0.03; // m/s
    if (fastest < slowest)
      return false;
    if (fastest < velocity.forward) {
      velocity.turn *= fastest / velocity.forward;
      velocity.forward = fastest;
    }
    return true;
  }

  void wait(const std::string& what) {
    drive({});
    if (waits_for_ != what)
      tell(what);
  }

  /// Two that wait for each other would do so forever, and so would a robot that is elsewhere than
  /// it knows, before a wall: people are told, and then it goes back and comes again.
  void wait_for_way() {
    if (!way_ended_)
      way_ended_ = now();
    if (patience_.get() == 0s || now() - *way_ended_ < patience_.get())
      return wait("a free way");
    const auto what = fmt::format("a free way, for more than {:.3g} s: clear it",
                                  std::chrono::duration<double>(patience_.get()).count());
    if (waits_for_ != what) {
      warning("waits for {}", what);
      recoveries_ = 0;
    }
    wait(what);
  }

  void begin_round() {
    recovered_at_ = 0;
    recoveries_ = 0;
    FollowOptions options;
    options.speed = speed_;
    options.look_ahead = look_ahead_;
    options.tolerance = tolerance_;
    follower_ = std::make_unique<PathFollower>(way_, options);
  }

  std::optional<PathProgress> progress_before() {
    try {
      return *read<PathProgress>(here(component_name()));
    } catch (const DoesNotExistOnWM&) {
      return std::nullopt;
    }
  }

  /// Overwrites the entry about its progress.
  void tell(const std::string& waits_for) {
    waits_for_ = waits_for;
    told_ = now();
    PathProgress x;
    x.time = told_.count();
    x.done = follower_->done();
    x.length = follower_->length();
    x.rounds = rounds_;
    x.arrived = rounds_ >= rounds_to_drive_;
    x.waits_for = waits_for;
    put(here(component_name()), x);
  }

  Option<std::string> path_{this, "path", "", "waypoints: X Y, X Y, ..., metres"};
  Option<std::string> file_{this, "file", "", "file of waypoints, one on a line, instead"};
  Option<std::string> base_{this, "base", "", "folder in which a relative file is looked for too"};
  Option<double> speed_{this, "speed", 0.5, "m/s"};
  Option<double> look_ahead_{this, "look-ahead", 0.4, "how far ahead on the path it aims, metres"};
  Option<double> tolerance_{this, "tolerance", 0.1,
                            "distance from the last waypoint at which it has arrived, metres"};
  Option<double> stop_before_{
    this, "stop-before", 0.3,
    "it stops so far before what is in its way, from the robot's middle, metres; 0: never"};
  Option<double> aside_{this, "aside", 0.3,
                        "how far from the path it steers past what reaches into it, metres; 0: not "
                        "at all"};
  Option<double> braking_{this, "braking", 0.4, "how hard it brakes for that, m/s^2"};
  Option<double> half_width_{this, "half-width", 0.27,
                             "how far aside that something may be, metres"};
  Option<std::chrono::milliseconds> patience_{
    this, "patience", 30000ms, "it asks people to clear the way after so long; 0: never"};
  Option<std::chrono::milliseconds> back_off_{
    this, "back-off", 6000ms,
    "it goes back a little if it has not come further for so long; 0: never"};
  Option<double> back_off_way_{this, "back-off-way", 0.5, "how far it goes back, metres"};
  Option<int> most_recoveries_{this, "recoveries", 3,
                               "how often it does so at one place before it waits"};
  Option<std::int64_t> rounds_to_drive_{this, "rounds", 1, "how often it drives the path"};
  Option<std::chrono::milliseconds> period_{this, "period", 50ms, "time between commands"};
  Option<AfterArrival> after_arrival_{this, "after", AfterArrival::stay,
                                      "what it does then: stay, or end the system"};

  Path way_;
  std::unique_ptr<PathFollower> follower_;
  StallRecovery recovery_;
  /// How often it went back since it was so far along the path.
  int recoveries_ = 0;
  double recovered_at_ = 0;
  double free_way_ = 1e9;
  SeenObstacles seen_;
  /// When it began to stand because of what is in its way.
  std::optional<Timestamp> way_ended_;
  std::int64_t rounds_ = 0;
  std::string waits_for_;
  Timestamp told_{0};
};

CASTOR_COMPONENT(PathDriver, "drives a robot along a given path")

} // namespace

} // namespace castor::mapping
