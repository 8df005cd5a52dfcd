#include "castor/actors/component/registry.hpp"
#include "castor/mapping/planar/lease_address.hpp"
#include "castor/mapping/safety/safety_rules.hpp"

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace castor::mapping {

namespace {

using namespace std::chrono_literals;

/// Stands between those who command a robot and its base: takes DriveCommand as the base does, and
/// passes on what is safe. It needs nobody but the base and its sensors.
class SafetyGuard final : public StandaloneComponent {
  void configure() override {
    SafetyOptions options;
    options.radius = radius_;
    if (!footprint_->empty())
      options.footprint = parse_footprint(footprint_.get(), "--footprint");
    options.turning_radius = turning_radius_;
    options.turn_braking = turn_braking_;
    options.margin = margin_;
    options.braking = braking_;
    options.latency = std::chrono::duration<double>(latency_.get()).count();
    options.creeping = creeping_;
    options.moving_margin = moving_margin_;
    options.unseen = unseen_;
    options.laser_patience = laser_patience_.get();
    options.odometry_patience = odometry_patience_.get();
    options.laser_has_noise = laser_has_noise_;
    rules_ = std::make_unique<SafetyRules>(options);
  }

  void start() override {
    on_push<Odometry>(sensors(odometry_), [this](auto& x) { rules_->add(*x, now().count()); });
    on_push<LaserScan>(sensors(laser_), [this](auto& x) {
      has_seen_ = true;
      rules_->add(*x, now().count());
      guard();
    });
    started_ = now();
    CommandTerms terms;
    terms.valid_for = valid_for_.get();
    terms.lease = address_of(lease_);
    on_command<DriveCommand>(
      [this](const DriveCommand& x) {
        commanded_ = x.velocity;
        guard();
      },
      [this] {
        commanded_.reset();
        guard();
      },
      terms);
    provide<SafetyState>([this] { return state_; });
    every(period_.get(), [this] {
      guard();
      miss_first_scan();
    });
  }

  /// Tells the base what is safe, once more if that has not changed: what it was told holds for a
  /// short time only. Nothing if nobody wants it to move.
  void guard() {
    const auto verdict = rules_->verdict(commanded_, now().count());
    const bool has_changed = verdict.reason != state_.reason;
    if (commanded_ || state_.allowed != Twist2{})
      send(verdict.velocity);
    state_ = {now().count(), commanded_.value_or(Twist2{}), verdict.velocity, verdict.reason,
              verdict.free_way};
    if (has_changed || now() - pushed_ >= state_period_.get())
      tell(has_changed);
  }

  /// While a system starts, scans may take a moment to come.
  void miss_first_scan() {
    if (has_seen_ || is_missed_ || now() - started_ < 2s)
      return;
    is_missed_ = true;
    warning("still waits for the first scan of {}; until then, nobody may move the robot",
            sensors(laser_));
  }

  void tell(bool has_changed) {
    pushed_ = now();
    push(state_);
    const auto reason = state_.reason;
    if (has_changed && has_seen_ &&
        (reason == SafetyReason::laser_silent || reason == SafetyReason::laser_frozen ||
         reason == SafetyReason::odometry_silent))
      warning("stops the robot: {}", name_of(reason));
  }

  static std::string_view name_of(SafetyReason x) {
    switch (x) {
      case SafetyReason::laser_silent:
        return "no scan comes";
      case SafetyReason::laser_frozen:
        return "the laser says the same again and again";
      default:
        return "no odometry comes";
    }
  }

  /// A refusal is logged once until the next success.
  void send(const Twist2& velocity) {
    try {
      stream_command(robot_.get(), DriveCommand{velocity}, hold_.get());
      is_refused_ = false;
    } catch (const ConnectionError& e) {
      if (!is_refused_)
        warning("{}", e.what());
      is_refused_ = true;
    }
  }

  std::string sensors(const std::string& own) const { return own.empty() ? robot_.get() : own; }

  Option<StandaloneName> robot_{this, "robot", "robot", "the robot that it guards"};
  Option<StandaloneName> laser_{this, "laser", "", "who pushes LaserScan; empty: the robot"};
  Option<StandaloneName> odometry_{this, "odometry", "", "who pushes Odometry; empty: the robot"};
  Option<std::string> lease_{
    this, "lease", "",
    "SUBARCHITECTURE/ID of the entry whose lease holder it obeys; empty: anybody"};
  Option<std::chrono::milliseconds> valid_for_{this, "valid-for", 200ms,
                                               "the robot stops so long after the last command"};
  Option<std::chrono::milliseconds> hold_{
    this, "hold", 150ms, "the robot stops so long after the last word of this component"};
  Option<std::chrono::milliseconds> period_{this, "period", 20ms, "time between two decisions"};
  Option<std::chrono::milliseconds> state_period_{this, "state-period", 100ms,
                                                  "time between pushes of SafetyState"};
  Option<double> radius_{this, "radius", 0.25, "footprint of the robot, a disc; metres"};
  Option<std::string> footprint_{
    this, "footprint", "", "corners of a robot that is no disc, X Y, X Y, ..., metres; empty: a disc"};
  Option<double> turning_radius_{
    this, "turning-radius", 0,
    "of the smallest circle that a robot drives as a car does, metres; 0: it turns on the spot"};
  Option<double> turn_braking_{this, "turn-braking", 1.5,
                               "how hard a robot that is no disc stops turning at least, rad/s^2"};
  Option<double> margin_{this, "margin", 0.05, "what it keeps away from obstacles, metres"};
  Option<double> braking_{this, "braking", 0.6, "how hard the robot brakes at least, m/s^2"};
  Option<std::chrono::milliseconds> latency_{
    this, "latency", 150ms, "from what can be seen until the robot brakes: scans and messages"};
  Option<double> creeping_{this, "creeping", 0.05, "speed within the margin, m/s"};
  Option<double> moving_margin_{this, "moving-margin", 0.15,
                                "what it keeps away from what moves, beside the margin; metres"};
  Option<double> unseen_{this, "unseen", 0.1,
                         "greatest speed to where the laser does not see, m/s"};
  Option<std::chrono::milliseconds> laser_patience_{this, "laser-patience", 230ms,
                                                    "it stops if no new scan comes for that long"};
  Option<std::chrono::milliseconds> odometry_patience_{
    this, "odometry-patience", 200ms, "it stops if no odometry comes for that long"};
  Option<bool> laser_has_noise_{
    this, "laser-has-noise", true,
    "whether no two scans are the same; if not, they may be while the robot stands"};

  std::unique_ptr<SafetyRules> rules_;
  /// Nothing if nobody commands.
  std::optional<Twist2> commanded_;
  SafetyState state_;
  Timestamp pushed_{0};
  Timestamp started_{0};
  bool has_seen_ = false;
  bool is_missed_ = false;
  bool is_refused_ = false;
};

CASTOR_COMPONENT(SafetyGuard, "lets a robot drive as it is told only where that is safe")

} // namespace

} // namespace castor::mapping
