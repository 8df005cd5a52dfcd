#pragma once

#include "castor/actors/component/actions.hpp"
#include "castor/actors/component/commands_from_seat.hpp"
#include "castor/base/named_file.hpp"
#include "castor/planning/manipulation/arm_file.hpp"
#include "castor/planning/manipulation/arm_model.hpp"
#include "castor/planning/manipulation/arm_placement.hpp"
#include "castor/planning/manipulation/manipulation_plan.hpp"
#include "castor/planning/manipulation/motion_window.hpp"
#include "castor/planning/manipulation/types.hpp"
#include "castor/wm/entries/failure.hpp"

#include <chrono>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

namespace castor::manipulation {

/// How a stage of a plan has ended.
struct StageEnd {
  enum class Kind {
    done,
    /// The action is to end; the arm comes to rest.
    cancelled,
    /// The gripper does not hold what it ought to.
    not_held,
    /// The arm does not go on.
    fault
  };

  Kind kind = Kind::done;
  std::string why;
  /// Name of the joint that does not follow, if it is that.
  std::string joint = {};
};

/// A component that commands an arm, in its seat: the arm obeys only who sits in it.
class CommandsArm : public CommandsFromSeat<ArmSeat> {
protected:
  void configure() override {
    arm_ = load_arm(file_named(arm_file_, base_.get())).arm;
    placement_ = arm_placement(at_);
    rest_ = arm_posture(arm_, rest_text_);
  }

  /// To be called in `start()`.
  void follow_arm() {
    on_push<ArmState>(effector_.get(), [this](auto& x) { state_ = *x; });
    // Other numbers than those of a predecessor.
    motion_ = now().count();
  }

  /// Lets the arm carry out a stage.
  /// @param goes_on is asked before each command: false if the stage is to end
  /// @param is_paused while it is true the arm gets no commands, and rests
  /// @param wait waits for the time between commands, and delivers events
  template <class GoesOn, class IsPaused, class Wait>
  StageEnd carry_out(const MotionStage& stage, GoesOn goes_on, IsPaused is_paused, Wait wait) {
    ++motion_;
    auto progress_at = now();
    double progress = -1;
    bool is_taken_up = false;
    while (true) {
      if (!goes_on()) {
        halt();
        return {StageEnd::Kind::cancelled, "it was cancelled"};
      }
      if (is_paused()) {
        progress_at = now();
        wait();
        continue;
      }
      if (!send(stage))
        progress_at = std::min(progress_at, now());
      wait();
      if (!state_ || state_->motion != motion_) {
        if (is_taken_up)
          return {StageEnd::Kind::fault, "the arm was started again meanwhile"};
        if (now() - progress_at > patience_.get())
          return {StageEnd::Kind::fault,
                  "the arm does not obey" + (refusal().empty() ? std::string{} : ": " + refusal())};
        continue;
      }
      is_taken_up = true;
      if (!state_->fault.empty())
        return {StageEnd::Kind::fault, state_->fault, state_->fault_joint};
      const bool is_over = state_->motion_time >= stage.trajectory.duration() && state_->rests;
      const bool has_to_hold = stage.holds.value_or(false);
      if (has_to_hold && !state_->holds &&
          (is_over || stage.status != ManipulationStatus::grasping))
        return {StageEnd::Kind::not_held, "it slipped out of the gripper"};
      if (is_over)
        return {};
      if (state_->motion_time > progress || !state_->rests) {
        progress = state_->motion_time;
        progress_at = now();
      } else if (now() - progress_at > patience_.get()) {
        return {StageEnd::Kind::fault, "the arm does not go on"};
      }
    }
  }

  /// Lets the arm come to rest, without waiting for it: its last command holds no longer.
  void halt() {
    if (!last_)
      return;
    try {
      stream_command(effector_.get(), *last_, std::chrono::milliseconds{1});
    } catch (const ConnectionError& e) {
      debug("{}", e.what());
    }
    last_.reset();
  }

  /// Null until the arm has told.
  const ArmState* state() const { return state_ ? &*state_ : nullptr; }

  const ArmModel& arm() const { return arm_; }
  /// Pose of the arm in the table's frame.
  const Pose& placement() const { return placement_; }
  /// Where it rests, out of the camera's sight.
  const Configuration& rest() const { return rest_; }
  std::chrono::milliseconds period() const { return period_; }

private:
  /// Does not wait for the arm. False if an earlier command was refused.
  bool send(const MotionStage& stage) {
    const double time = state_ && state_->motion == motion_ ? state_->motion_time : 0;
    auto command = motion_window(stage.trajectory, motion_, time);
    command.opening = stage.opening;
    command.pushes = stage.pushes;
    last_ = command;
    return command_from_seat(effector_.get(), std::move(command));
  }

  Option<StandaloneName> effector_{this, "arm", "arm", "the arm to command"};
  Option<std::string> arm_file_{this, "model", "arms/katana.arm", "file of the arm"};
  Option<std::string> base_{this, "base", "", "folder in which relative files are looked for too"};
  Option<std::string> at_{this, "at", "0 -0.33 heading 90",
                          "where it stands on the table: X Y heading DEGREES"};
  Option<std::string> rest_text_{
    this, "rest", "90 -20 110 60 90",
    "where it rests, out of the camera's sight: a number for each joint, degrees"};
  Option<std::chrono::milliseconds> period_{this, "period", std::chrono::milliseconds{40},
                                            "time between commands"};
  Option<std::chrono::milliseconds> patience_{
    this, "patience", std::chrono::seconds{4},
    "a motion that does not go on for so long has failed"};

  ArmModel arm_;
  Pose placement_;
  Configuration rest_;
  std::optional<ArmState> state_;
  std::optional<ArmCommand> last_;
  std::int64_t motion_ = 0;
};

} // namespace castor::manipulation
