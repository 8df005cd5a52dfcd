#include "castor/actors/component/registry.hpp"
#include "castor/base/named_file.hpp"
#include "castor/base/text_file.hpp"
#include "castor/perception/vision/tabletop/tabletop_scene_parser.hpp"
#include "castor/planning/body/arm_body.hpp"
#include "castor/planning/body/kept_arms.hpp"
#include "castor/planning/body/saved_arm_text.hpp"
#include "castor/planning/body/table_things.hpp"
#include "castor/planning/manipulation/arm_file.hpp"
#include "castor/planning/manipulation/arm_placement.hpp"
#include "castor/planning/manipulation/types.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

namespace castor::manipulation {

namespace {

using namespace std::chrono_literals;

/// An arm at the table of a scene: obeys ArmCommand, pushes and provides ArmState and ArmStatus,
/// and provides TableView for a TableCamera.
class SimulatedArm final : public StandaloneComponent {
  void configure() override {
    if (scene_->empty())
      throw std::invalid_argument(
        "--scene is not set: name the file of a table's scene, for example scenes/arm.scene");
    auto scene = vision::load_tabletop_scene(file_named(scene_, base_.get()));
    for (auto& x : scene.problems)
      warning("{}", render(x));
    if (scene.scene.change_times().size() > 1)
      warning("{}: what happens later is left out: the arm moves things now", scene_.get());
    auto arm = load_arm(file_named(arm_file_, base_.get()));
    for (auto& x : arm.problems)
      warning("{}", render(x));
    things_.emplace(scene.scene.at(vision::SceneTime{0}), arm_placement(at_));
    ArmBodyOptions options;
    options.seed = static_cast<std::uint64_t>(seed_.get());
    options.stop_time = std::chrono::duration<double>(stop_time_.get()).count();
    options.missed_grasp = missed_grasp_;
    options.dropped = dropped_;
    step_ = options.step;
    const auto start = arm_posture(arm.arm, start_);
    stuck_joint_ = joint_named(arm.arm);
    body_ = std::make_shared<ArmBody>(std::move(arm.arm), things_->world(), start, options);
    if (const auto folder = std::filesystem::path{state_file_.get()}.parent_path(); !folder.empty())
      std::filesystem::create_directories(folder);
    state_steps_ = state_period_.get() / step_;
    if (state_steps_ < 1)
      throw std::invalid_argument("--state-period is less than 10 ms, the step of the simulation");
  }

  std::optional<std::size_t> joint_named(const ArmModel& arm) const {
    if (sticking_joint_->empty())
      return {};
    const auto moving = moving_joints(arm);
    std::string names;
    for (std::size_t i = 0; i < moving.size(); ++i) {
      if (arm.joints[moving[i]].name == sticking_joint_.get())
        return i;
      names += ' ' + arm.joints[moving[i]].name;
    }
    throw std::invalid_argument("--sticking-joint: there is no joint " + sticking_joint_.get() +
                                " that moves; name one of" + names);
  }

  void start() override {
    restore();
    begun_ = now() - body_->time();
    provide<ArmState>([this] { return state(); });
    provide<ArmStatus>([this] { return status(); });
    provide<TableView>([this] {
      advance();
      return TableView{body_->changes(), now().count(), things_->view(*body_)};
    });
    CommandTerms terms;
    terms.valid_for = valid_for_.get();
    if (!lease_->empty())
      terms.lease = address_of(lease_);
    if (!commander_->empty())
      terms.commander = commander_.get();
    on_command<ArmCommand>([this](const ArmCommand& x) { obey(x); }, [this] { take_safe_state(); },
                           terms);
    every(step_ * state_steps_, [this] { advance(); });
  }

  /// The world does not begin anew if the component that simulates it fails, nor, with a state
  /// file, if its process does.
  void restore() {
    if (!state_file_->empty()) {
      restore_from_file();
      return;
    }
    const auto kept = KeptArms::instance().find(component_name());
    if (!kept.body || !is_of_this_run(kept.time))
      return;
    body_ = kept.body;
    body_->release();
    info("goes on where it was {} ms ago", (now() - kept.time) / 1ms);
  }

  void restore_from_file() {
    std::optional<TimedArm> saved;
    try {
      saved = parse_saved_arm(load_text(state_file_.get()));
    } catch (const TextFileError&) {
      // There is none yet.
      return;
    }
    if (!saved || !is_of_this_run(std::chrono::microseconds{saved->time}))
      return;
    try {
      body_->resume(saved->state);
      reported_collisions_ = saved->state.collisions;
      info("goes on where it was {} ms ago",
           (now() - std::chrono::microseconds{saved->time}) / 1ms);
    } catch (const std::invalid_argument& e) {
      warning("{}: {}; begins anew", state_file_.get(), e.what());
    }
  }

  bool is_of_this_run(Timestamp saved) const {
    return saved <= now() && saved >= now() - lost_after && now() >= 500ms;
  }

  static Address address_of(const std::string& text) {
    const auto slash = text.find('/');
    if (slash == 0 || slash == text.npos || slash + 1 == text.size())
      throw std::invalid_argument("--lease: '" + text +
                                  "' is no address of an entry; write SUBARCHITECTURE/ID");
    return {text.substr(0, slash), text.substr(slash + 1)};
  }

  /// The controller takes up a command when its delay is over. Motors have a watchdog of their own,
  /// for a process that is stopped or hangs.
  void obey(const ArmCommand& x) {
    advance();
    waiting_.push_back({now() + delay_.get(), now() + valid_for_.get(), x});
    take_up_commands();
  }

  void take_up_commands() {
    const auto time = begun_ + body_->time();
    while (!waiting_.empty() && waiting_.front().due <= time + step_) {
      const auto [due, until, command] = std::move(waiting_.front());
      waiting_.pop_front();
      const auto holds = std::chrono::duration_cast<std::chrono::microseconds>(until - time);
      body_->command(command, std::max(0us, holds));
    }
  }

  void take_safe_state() {
    advance();
    waiting_.clear();
    body_->release();
  }

  /// Steps up to now, with what is to be pushed in between.
  void advance() {
    while (begun_ + body_->time() + step_ <= now()) {
      take_up_commands();
      if (stuck_joint_ && now() >= sticks_after_.get())
        body_->stick(*stuck_joint_);
      body_->step();
      if (body_->steps() % state_steps_ == 0) {
        push(state());
        push(status());
      }
    }
    report_collisions();
    if (state_file_->empty())
      KeptArms::instance().keep(component_name(), {body_, now()});
    else
      save();
  }

  void save() {
    const auto since = now() - saved_at_;
    const bool has_changed = body_->changes() != saved_changes_;
    if (since < (has_changed ? changed_save_period : save_period))
      return;
    saved_at_ = now();
    saved_changes_ = body_->changes();
    try {
      save_text(state_file_.get(), saved_arm_text({saved_at_.count(), body_->saved()}));
    } catch (const TextFileError& e) {
      if (!std::exchange(is_unsaved_, true))
        warning("{}", e.what());
    }
  }

  void report_collisions() {
    const auto status = body_->status();
    if (status.collisions > reported_collisions_)
      warning("collision {}: {}", status.collisions, status.collision);
    reported_collisions_ = status.collisions;
  }

  /// The body's time begins when the world does, and that of what it says when the system does.
  std::int64_t offset() const {
    return std::chrono::duration_cast<std::chrono::microseconds>(begun_).count();
  }

  ArmState state() const {
    auto x = body_->state();
    x.time += offset();
    return x;
  }

  ArmStatus status() const {
    auto x = body_->status();
    x.time += offset();
    for (auto& thing : x.things)
      thing.pose = things_->on_table(thing.pose);
    return x;
  }

  /// What waits for the controller.
  struct WaitingCommand {
    Timestamp due{0};
    Timestamp until{0};
    ArmCommand command;
  };

  /// A world that was kept that long ago is one of another run.
  static constexpr std::chrono::seconds lost_after{60};
  /// Time between two savings, while nothing moves and while something does.
  static constexpr std::chrono::milliseconds save_period{500};
  static constexpr std::chrono::milliseconds changed_save_period{100};

  Option<std::string> scene_{this, "scene", "", "file of the table's scene"};
  Option<std::string> arm_file_{this, "arm", "arms/katana.arm", "file of the arm"};
  Option<std::string> base_{this, "base", "", "folder in which relative files are looked for too"};
  Option<std::string> at_{this, "at", "0 -0.33 heading 90",
                          "where it stands on the table: X Y heading DEGREES"};
  Option<std::string> start_{this, "start", "",
                             "a number for each joint, degrees; empty: its home"};
  Option<std::string> lease_{
    this, "lease", "",
    "SUBARCHITECTURE/ID of the entry whose lease holder it obeys; empty: anybody"};
  Option<StandaloneName> commander_{this, "commander", "",
                                    "the only component that it obeys; empty: anybody"};
  Option<std::chrono::milliseconds> valid_for_{
    this, "valid-for", 300ms, "it comes to rest if there is no command for so long"};
  Option<std::chrono::milliseconds> stop_time_{this, "stop-time", 800ms, "from full speed to rest"};
  Option<std::chrono::milliseconds> state_period_{this, "state-period", 20ms,
                                                  "time between pushes of ArmState"};
  Option<std::int64_t> seed_{this, "seed", 1, "of faults"};
  Option<double> missed_grasp_{this, "missed-grasp", 0,
                               "fault: probability that fingers slip off when they close"};
  Option<double> dropped_{this, "dropped", 0,
                          "fault: probability that a thing is lost after it was grasped"};
  Option<std::string> sticking_joint_{this, "sticking-joint", "", "fault: this joint sticks"};
  Option<std::chrono::milliseconds> sticks_after_{this, "sticks-after", 0ms,
                                                  "when the joint sticks"};
  Option<std::chrono::milliseconds> delay_{this, "delay", 0ms,
                                           "fault: the controller obeys so much later"};

  Option<std::string> state_file_{
    this, "state", "",
    "file that keeps where the arm and the things are, for when its process is restarted"};

  std::optional<TableThings> things_;
  std::shared_ptr<ArmBody> body_;
  std::chrono::microseconds step_{0};
  std::int64_t state_steps_ = 0;
  std::optional<std::size_t> stuck_joint_;
  std::deque<WaitingCommand> waiting_;
  Timestamp begun_{0};
  std::int64_t reported_collisions_ = 0;
  Timestamp saved_at_{0};
  std::uint64_t saved_changes_ = 0;
  bool is_unsaved_ = false;
};

CASTOR_COMPONENT(SimulatedArm, "an arm at a simulated table, which a TableCamera sees")

} // namespace

} // namespace castor::manipulation
