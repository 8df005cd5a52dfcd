#pragma once

#include "castor/actors/component/action_types.hpp"
#include "castor/planning/manipulation/components/executes_manipulation.hpp"

#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

namespace castor::manipulation {

/// A component that executes actions of an arm, and puts in order what a predecessor has left.
class ResumesManipulation : public ExecutesManipulation {
protected:
  /// A predecessor may have left the arm in the picture, with something in the gripper.
  void resume() {
    is_resumed_ = is_resuming_ = true;
    resume_at_rest();
    is_resuming_ = false;
  }

  /// What a predecessor has left was dealt with, or is dealt with just now.
  bool is_resumed() const { return is_resumed_; }

  /// Where there is room, best in the middle of the table.
  ActionResult put_down_anywhere() {
    if (auto end = look())
      return *end;
    for (const bool wide : {false, true})
      for (const auto& pose : poses_held())
        for (const auto& x : free_places(things_, held_->solid.size.x, wide)) {
          held_->pose = pose;
          const PlaceGoal goal{x, 0, "the table", "a free place"};
          const auto plan = planned([&] { return planner_->place(scene(), goal, joints()); });
          if (!plan)
            continue;
          const auto carried = carry_out_all(*plan);
          return carried.is_done ? ActionResult::succeeded()
                                 : carried.end.value_or(ActionResult::failed(told_.reason));
        }
    return ActionResult::failed("there is no free place for " + held_->name);
  }

private:
  void resume_at_rest() {
    const bool is_known = !state()->holds || take_over();
    // As they were before the arm came into the picture.
    things_ = look_at_table(placement());
    std::erase_if(things_, [&](const auto& x) { return held_ && x.id == held_thing_.id; });
    if (!state()->holds && !is_at_rest())
      take_over_place();
    if (is_at_rest() && is_known)
      return tell(ManipulationStatus::idle, "rests");
    inhibit_vision();
    begin(is_known ? "go home" : "put down " + held_->name, {});
    finish(is_known ? withdraw() : put_down_anywhere());
  }

  /// How it may be held: of what nobody knows, in any way that it can be put down.
  std::vector<Pose> poses_held() const {
    if (!held_thing_.id.empty())
      return {held_->pose};
    std::vector<Pose> result;
    for (const double degrees : {180.0, 150.0, 210.0, 120.0, 240.0}) {
      const double half = degrees / 360 * std::numbers::pi;
      result.push_back({{}, {std::cos(half), 0, std::sin(half), 0}, "tool"});
    }
    return result;
  }

  bool is_resumed_ = false;
};

} // namespace castor::manipulation
