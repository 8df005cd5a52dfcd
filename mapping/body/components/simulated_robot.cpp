#include "castor/actors/component/registry.hpp"
#include "castor/mapping/body/components/named_file.hpp"
#include "castor/mapping/body/simulated_body.hpp"
#include "castor/mapping/building/building_file.hpp"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

namespace castor::mapping {

CASTOR_REFLECT_ENUM(Wheel, none, left, right)

namespace {

using namespace std::chrono_literals;

/// Where odometry begins.
enum class OdometryStart { start, zero };
CASTOR_REFLECT_ENUM(OdometryStart, start, zero)

/// A robot in a simulated building: obeys DriveCommand, pushes and provides Odometry, LaserScan and
/// BodyStatus.
class SimulatedRobot final : public StandaloneComponent {
  void configure() override {
    if (building_->empty())
      throw std::invalid_argument(
        "--building is not set: name a building's file, for example buildings/office.building");
    auto read = load_building(file_named(building_, base_));
    for (auto& x : read.problems)
      warning("{}", render(x));
    auto& building = read.building;
    set_doors(building, shut_, false);
    set_doors(building, opened_, true);
    BodyOptions options;
    options.seed = static_cast<std::uint64_t>(seed_.get());
    options.people = people_;
    options.laser.field_of_view = laser_;
    options.laser.beams_per_degree = beams_per_degree_;
    options.laser.max_range = max_range_;
    options.laser.range_noise = range_noise_;
    options.laser.missing = missing_;
    options.drive.wheel_base = wheel_base_;
    options.drive.max_forward = max_speed_;
    options.drive.max_turn = max_turn_;
    options.drive.acceleration = acceleration_;
    options.drive.slip = slip_;
    options.drive.diameter_error = diameter_error_;
    if (odometry_start_ == OdometryStart::start)
      options.odometry_start = building.start;
    step_ = options.step;
    body_ = std::make_unique<SimulatedBody>(surroundings_in(building, options), options);
    odometry_steps_ = steps_in(odometry_period_, "--odometry-period");
    scan_steps_ = steps_in(scan_period_, "--scan-period");
    info("drives in {}", building_.get());
  }

  void start() override {
    begun_ = now();
    provide<Odometry>([this] { return odometry(); });
    provide<LaserScan>([this] { return newest_scan(); });
    provide<BodyStatus>([this] { return status(); });
    CommandTerms terms;
    terms.valid_for = valid_for_.get();
    terms.lease = address_of(lease_);
    on_command<DriveCommand>([this](const DriveCommand& x) { body_->command(x.velocity); },
                             [this] { body_->command({}); }, terms);
    every(step_ * std::min(odometry_steps_, scan_steps_), [this] { advance(); });
  }

  /// Steps up to now, with what is to be pushed in between.
  void advance() {
    const auto due = (now() - begun_) / step_;
    while (body_->steps() < due) {
      block_wheel();
      body_->step();
      if (body_->steps() % odometry_steps_ == 0) {
        push(odometry());
        push(status());
      }
      if (body_->steps() % scan_steps_ == 0 && laser_works())
        push(scan());
    }
    report_collisions();
  }

  void block_wheel() {
    if (blocked_wheel_ != Wheel::none && now() >= blocks_after_.get()) {
      body_->block(blocked_wheel_);
    }
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

  Option<std::string> building_{this, "building", "", "file of the building that it drives in"};
  Option<std::string> base_{this, "base", "", "folder in which a relative file is looked for too"};
  Option<std::int64_t> seed_{this, "seed", 1, "of slip and of noise"};
  Option<std::vector<std::string>> shut_{this, "shut", {}, "names of doors to shut"};
  Option<std::vector<std::string>> opened_{this, "open", {}, "names of doors to open"};
  Option<bool> people_{this, "people", false, "whether people walk along their routes"};
  Option<std::string> lease_{
    this, "lease", "",
    "SUBARCHITECTURE/ID of the entry whose lease holder it obeys; empty: anybody"};
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
  Option<std::chrono::milliseconds> laser_stops_after_{
    this, "laser-stops-after", 0ms, "fault: no scan comes any more from then on; 0: never"};
  Option<Wheel> blocked_wheel_{this, "blocked-wheel", Wheel::none, "fault: this wheel blocks"};
  Option<std::chrono::milliseconds> blocks_after_{this, "blocks-after", 0ms,
                                                  "when the wheel blocks"};

  std::unique_ptr<SimulatedBody> body_;
  std::chrono::microseconds step_{0};
  std::int64_t odometry_steps_ = 0;
  std::int64_t scan_steps_ = 0;
  Timestamp begun_{0};
  std::optional<LaserScan> scan_;
  std::int64_t reported_collisions_ = 0;
};

CASTOR_COMPONENT(SimulatedRobot, "drives in a simulated building, with odometry and a laser")

} // namespace

} // namespace castor::mapping
