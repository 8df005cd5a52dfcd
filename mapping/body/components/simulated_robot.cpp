#include "castor/actors/component/registry.hpp"
#include "castor/base/named_file.hpp"
#include "castor/base/text_file.hpp"
#include "castor/mapping/body/body_state_text.hpp"
#include "castor/mapping/body/kept_bodies.hpp"
#include "castor/mapping/body/map_surroundings.hpp"
#include "castor/mapping/body/scene_camera.hpp"
#include "castor/mapping/body/simulated_body.hpp"
#include "castor/mapping/building/building_file.hpp"
#include "castor/mapping/building/building_statement.hpp"
#include "castor/mapping/building/solids.hpp"
#include "castor/mapping/octree/types.hpp"
#include "castor/mapping/planar/lease_address.hpp"
#include "castor/perception/vision/types.hpp"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace castor::mapping {

CASTOR_REFLECT_ENUM(Wheel, none, left, right)

namespace {

using namespace std::chrono_literals;

/// Time between two savings of the body's state.
constexpr std::chrono::milliseconds save_period = 500ms;

/// Where odometry begins.
enum class OdometryStart { start, zero };
CASTOR_REFLECT_ENUM(OdometryStart, start, zero)

/// A robot in a simulated building: obeys DriveCommand, pushes and provides Odometry, LaserScan and
/// BodyStatus, and, if it has a camera, pushes vision::CameraFrame and SensedCloud.
class SimulatedRobot final : public StandaloneComponent {
  void configure() override {
    if (building_->empty())
      throw std::invalid_argument(
        "--building is not set: name a building's file, for example buildings/office.building");
    BodyOptions options;
    options.seed = static_cast<std::uint64_t>(seed_.get());
    options.people = people_;
    options.legs = legs_;
    options.considerate = considerate_;
    options.laser.field_of_view = laser_;
    options.laser.beams_per_degree = beams_per_degree_;
    options.laser.max_range = max_range_;
    options.laser.range_noise = range_noise_;
    options.laser.missing = missing_;
    options.drive.wheel_base = wheel_base_;
    options.drive.turning_radius = turning_radius_;
    options.radius = radius_;
    if (!footprint_->empty())
      options.footprint = parse_footprint(footprint_.get(), "--footprint");
    options.drive.max_forward = max_speed_;
    options.drive.max_turn = max_turn_;
    options.drive.acceleration = acceleration_;
    options.drive.slip = slip_;
    options.drive.diameter_error = diameter_error_;
    auto surroundings = surroundings_with(options);
    if (!start_->empty())
      surroundings.start = pose_named("--start", start_);
    if (odometry_start_ == OdometryStart::start)
      options.odometry_start = surroundings.start;
    if (!kidnapped_to_->empty())
      pose_named("--kidnap-to", kidnapped_to_);
    step_ = options.step;
    body_ = std::make_unique<SimulatedBody>(std::move(surroundings), options);
    if (camera_period_.get() > 0ms)
      set_up_camera(options.seed);
    odometry_steps_ = steps_in(odometry_period_, "--odometry-period");
    scan_steps_ = steps_in(scan_period_, "--scan-period");
    info("drives in {}", building_.get());
  }

  /// Of a building's file, or of a map of ROS's map_server.
  BodySurroundings surroundings_with(const BodyOptions& options) {
    const auto file = file_named(building_, base_.get());
    if (file.extension() == ".yaml") {
      if (start_->empty())
        throw std::invalid_argument("a map does not say where the robot begins: write --start "
                                    "\"X Y heading DEGREES\"");
      return surroundings_in_map(file);
    }
    auto read = load_building(file);
    for (auto& x : read.problems)
      warning("{}", render(x));
    set_doors(read.building, shut_, false);
    set_doors(read.building, opened_, true);
    solids_ = solids_of(read.building);
    ceiling_ = read.building.height;
    return surroundings_in(read.building, options);
  }

  /// @param option whose value it is
  static Pose2 pose_named(const std::string& option, const std::string& value) {
    std::vector<std::string> words;
    for (auto& line : text_lines(value))
      words.insert(words.end(), line.words.begin(), line.words.end());
    StatementWords statement(words);
    try {
      auto pose = read_start(statement);
      statement.expect_end();
      return pose;
    } catch (const StatementError& e) {
      throw std::invalid_argument(option + ": " + e.what() + ". " + e.remedy());
    }
  }

  void set_up_camera(std::uint64_t seed) {
    if (solids_.empty())
      throw std::invalid_argument("a camera sees nothing in a map: leave --camera-period out, or "
                                  "name a building's file");
    CameraOptions options;
    options.width = camera_width_;
    options.height = camera_height_;
    camera_.emplace(options, seed);
    camera_steps_ = steps_in(camera_period_, "--camera-period");
  }

  void start() override {
    begun_ = now();
    restore();
    provide<Odometry>([this] { return odometry(); });
    provide<LaserScan>([this] { return newest_scan(); });
    provide<BodyStatus>([this] { return status(); });
    if (camera_)
      provide<vision::CameraFrame>([this] { return frame_; });
    CommandTerms terms;
    terms.valid_for = valid_for_.get();
    terms.lease = address_of(lease_);
    if (!commander_->empty())
      terms.commander = commander_.get();
    on_command<DriveCommand>([this](const DriveCommand& x) { obey(x.velocity); },
                             [this] { take_safe_state(); }, terms);
    every(period(), [this] { advance(); });
    if (camera_)
      look();
  }

  /// Motors have a watchdog of their own, for a process that is stopped or hangs.
  void obey(const Twist2& velocity) {
    catch_up();
    const auto behind = now() - begun_ - body_->time();
    body_->command(velocity, valid_for_.get() + behind);
  }

  void take_safe_state() {
    catch_up();
    body_->command({});
  }

  /// What the robot did while its process was stopped comes before what it is told now.
  void catch_up() {
    if (now() - begun_ - body_->time() > 2 * period())
      advance();
  }

  std::chrono::microseconds period() const {
    return step_ * std::min(odometry_steps_, scan_steps_);
  }

  /// Steps up to now, with what is to be pushed in between.
  void advance() {
    const auto due = (now() - begun_) / step_;
    while (body_->steps() < due) {
      block_wheel();
      kidnap();
      body_->step();
      if (body_->steps() % odometry_steps_ == 0) {
        push(odometry());
        push(status());
      }
      if (body_->steps() % scan_steps_ == 0 && laser_works())
        push(scan());
      if (camera_ && body_->steps() % camera_steps_ == 0)
        look();
    }
    report_collisions();
    if (state_file_->empty())
      KeptBodies::instance().keep(component_name(), {now().count(), body_->state()});
    else if (now() - saved_ >= save_period)
      save();
  }

  /// The robot does not go back to its start if the component that simulates it fails, nor, with a
  /// state file, if its process does.
  void restore() {
    const auto saved = saved_body();
    // Of a run before this one.
    if (!saved || saved->time > begun_.count() || begun_ < save_period)
      return;
    body_->resume(saved->state);
    reported_collisions_ = saved->state.collisions;
    info("goes on where it was {} ms ago", (begun_.count() - saved->time) / 1000);
  }

  std::optional<SavedBody> saved_body() {
    if (state_file_->empty())
      return KeptBodies::instance().find(component_name());
    try {
      return parse_body_state(load_text(state_file_.get()));
    } catch (const TextFileError&) {
      // There is none.
      return std::nullopt;
    }
  }

  void save() {
    saved_ = now();
    try {
      save_text(state_file_.get(), body_state_text({saved_.count(), body_->state()}));
    } catch (const TextFileError& e) {
      if (!std::exchange(is_unsaved_, true))
        warning("{}", e.what());
    }
  }

  /// Pushes a picture, and the points that its pixels are at.
  void look() {
    const auto view =
      camera_->look(solids_, body_->people().discs(), ceiling_, body_->status().pose);
    frame_.camera = camera_->model();
    frame_.image.width = static_cast<std::uint32_t>(frame_.camera.width);
    frame_.image.height = static_cast<std::uint32_t>(frame_.camera.height);
    frame_.image.bytes = view.colours;
    frame_.time = status().time;
    frame_.index = looks_++;
    push(frame_);
    SensedCloud cloud;
    cloud.time = frame_.time;
    cloud.sensor = frame_.camera.pose.position;
    cloud.coordinates = camera_->points_of(view);
    push(std::move(cloud));
  }

  void block_wheel() {
    if (blocked_wheel_ != Wheel::none && now() >= blocks_after_.get())
      body_->block(blocked_wheel_);
  }

  void kidnap() {
    if (kidnapped_to_->empty() || is_kidnapped_ || now() < kidnapped_after_.get())
      return;
    is_kidnapped_ = true;
    body_->carry_to(pose_named("--kidnap-to", kidnapped_to_));
    warning("somebody has carried the robot to {:.2f} {:.2f}", body_->status().pose.x,
            body_->status().pose.y);
  }

  bool laser_works() { return laser_stops_after_.get() == 0ms || now() < laser_stops_after_.get(); }

  void report_collisions() {
    const auto count = body_->status().collisions;
    if (count > reported_collisions_)
      warning("collision {}: the robot has run into something at {:.2f} {:.2f}", count,
              body_->status().pose.x, body_->status().pose.y);
    reported_collisions_ = count;
  }

  /// The body's time begins when this component does, and that of what it says when the system
  /// does.
  std::int64_t offset() const {
    return std::chrono::duration_cast<std::chrono::microseconds>(begun_).count();
  }

  Odometry odometry() {
    auto x = body_->odometry();
    x.time += offset();
    return x;
  }

  LaserScan scan() {
    auto x = body_->scan();
    x.time += offset();
    if (scan_ && laser_freezes_after_.get() > 0ms && now() >= laser_freezes_after_.get())
      x.ranges = scan_->ranges;
    scan_ = x;
    return x;
  }

  LaserScan newest_scan() {
    if (!scan_)
      scan();
    return *scan_;
  }

  BodyStatus status() {
    auto x = body_->status();
    x.time += offset();
    return x;
  }

  std::int64_t steps_in(std::chrono::milliseconds period, const std::string& option) const {
    if (period < step_ || period % step_ != 0ms)
      throw std::invalid_argument(option + " is no multiple of 10 ms, the step of the simulation");
    return period / step_;
  }

  void set_doors(Building& building, const std::vector<std::string>& names, bool open) const {
    for (const auto& name : names) {
      auto door = std::ranges::find(building.doors, name, &Door::name);
      if (door == building.doors.end())
        throw std::invalid_argument("there is no door '" + name + "' in " + building_.get() +
                                    "; `castor building show` draws those that there are");
      door->is_open = open;
    }
  }

  Option<std::string> building_{this, "building", "",
                                "file of the building that it drives in, or .yaml of a map"};
  Option<std::string> start_{this, "start", "",
                             "where it begins, as in a building's file: X Y heading DEGREES"};
  Option<std::string> base_{this, "base", "", "folder in which a relative file is looked for too"};
  Option<std::int64_t> seed_{this, "seed", 1, "of slip and of noise"};
  Option<std::vector<std::string>> shut_{this, "shut", {}, "names of doors to shut"};
  Option<std::vector<std::string>> opened_{this, "open", {}, "names of doors to open"};
  Option<bool> people_{this, "people", false, "whether people walk along their routes"};
  Option<bool> legs_{this, "legs", false, "whether the laser sees people's legs, not discs"};
  Option<bool> considerate_{this, "considerate", false,
                            "whether people keep clear of one another; else they walk through one "
                            "another"};
  Option<std::string> lease_{
    this, "lease", "",
    "SUBARCHITECTURE/ID of the entry whose lease holder it obeys; empty: anybody"};
  Option<StandaloneName> commander_{this, "commander", "",
                                    "the only component that it obeys; empty: anybody"};
  Option<std::chrono::milliseconds> valid_for_{this, "valid-for", 300ms,
                                               "the robot stops so long after the last command"};
  Option<std::chrono::milliseconds> odometry_period_{this, "odometry-period", 20ms,
                                                     "time between pushes of Odometry"};
  Option<std::chrono::milliseconds> scan_period_{this, "scan-period", 100ms,
                                                 "time between pushes of LaserScan"};
  Option<int> laser_{this, "laser", 180, "field of view of the laser, degrees"};
  Option<int> beams_per_degree_{this, "beams-per-degree", 1, "of the laser"};
  Option<double> max_range_{this, "max-range", 12, "of the laser, metres"};
  Option<double> range_noise_{this, "range-noise", 0.01, "standard deviation of ranges, metres"};
  Option<double> missing_{this, "missing", 0.003, "share of beams that do not come back"};
  Option<std::chrono::milliseconds> camera_period_{
    this, "camera-period", 0ms, "time between pushes of CameraFrame and SensedCloud; 0: no camera"};
  Option<int> camera_width_{this, "camera-width", 160, "pixels"};
  Option<int> camera_height_{this, "camera-height", 120, "pixels"};
  Option<double> radius_{this, "radius", 0.25, "of its footprint, a disc; metres"};
  Option<std::string> footprint_{
    this, "footprint", "",
    "corners of its footprint in order, X Y, X Y, ..., metres; empty: a disc"};
  Option<double> turning_radius_{
    this, "turning-radius", 0,
    "of the smallest circle that it drives, as of a car, metres; 0: it turns on the spot"};
  Option<double> wheel_base_{this, "wheel-base", 0.4, "distance of the wheels, metres"};
  Option<double> max_speed_{this, "max-speed", 0.8, "greatest speed, m/s"};
  Option<double> max_turn_{this, "max-turn", 1.6, "greatest speed of a turn, rad/s"};
  Option<double> acceleration_{this, "acceleration", 0.8, "m/s^2"};
  Option<double> slip_{this, "slip", 0.003,
                       "standard deviation of what a wheel slips on a metre, metres"};
  Option<double> diameter_error_{this, "diameter-error", 0.0005,
                                 "standard deviation of the relative error of a wheel's diameter"};
  Option<OdometryStart> odometry_start_{
    this, "odometry-start", OdometryStart::start,
    "where odometry begins: at the start in the building, or at zero"};
  Option<std::string> state_file_{
    this, "state", "", "file that keeps where the robot is, for when its process is restarted"};
  Option<std::chrono::milliseconds> laser_stops_after_{
    this, "laser-stops-after", 0ms, "fault: no scan comes any more from then on; 0: never"};
  Option<std::chrono::milliseconds> laser_freezes_after_{
    this, "laser-freezes-after", 0ms,
    "fault: from then on the same ranges come again and again; 0: never"};
  Option<Wheel> blocked_wheel_{this, "blocked-wheel", Wheel::none, "fault: this wheel blocks"};
  Option<std::chrono::milliseconds> blocks_after_{this, "blocks-after", 0ms,
                                                  "when the wheel blocks"};
  Option<std::string> kidnapped_to_{this, "kidnap-to", "",
                                    "fault: somebody carries it there: X Y heading DEGREES"};
  Option<std::chrono::milliseconds> kidnapped_after_{this, "kidnap-after", 0ms,
                                                     "when somebody carries it away"};

  std::unique_ptr<SimulatedBody> body_;
  std::chrono::microseconds step_{0};
  std::int64_t odometry_steps_ = 0;
  std::int64_t scan_steps_ = 0;
  Timestamp begun_{0};
  std::optional<LaserScan> scan_;
  /// What the camera sees.
  std::vector<Solid> solids_;
  double ceiling_ = 0;
  std::optional<SceneCamera> camera_;
  std::int64_t camera_steps_ = 0;
  vision::CameraFrame frame_;
  std::uint64_t looks_ = 0;
  std::int64_t reported_collisions_ = 0;
  bool is_kidnapped_ = false;
  Timestamp saved_{0};
  bool is_unsaved_ = false;
};

CASTOR_COMPONENT(SimulatedRobot, "drives in a simulated building, with odometry and a laser")

} // namespace

} // namespace castor::mapping
