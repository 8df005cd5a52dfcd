#pragma once

#include "castor/planning/manipulation/blocked_way.hpp"
#include "castor/planning/manipulation/trajectory.hpp"
#include "castor/planning/manipulation/types.hpp"

#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace castor::manipulation {

/// A motion from rest to rest, and the gripper during and after it.
struct MotionStage {
  ManipulationStatus status = ManipulationStatus::moving;
  /// For people: "reaches for the blue sphere".
  std::string text;
  Trajectory trajectory;
  /// What the gripper is to open to, metres.
  double opening = 0;
  bool pushes = false;
  /// Whether the gripper has to hold something in the end, if that matters.
  std::optional<bool> holds = {};
  /// What the gripper takes in the end; its pose is in the tool's frame.
  std::optional<NamedSolid> takes = {};
};

/// What an arm does, one stage after the other; each begins where the one before ends.
struct ManipulationPlan {
  std::vector<MotionStage> stages;
  /// How many motions were planned for it.
  int motions = 0;
  /// Where the thing is in the end, in the arm's frame, if it is put down.
  std::optional<Pose> goal;
  /// What the gripper holds in the end; its pose is in the tool's frame.
  std::optional<NamedSolid> held;

  /// Joints in the end.
  Configuration end() const {
    const auto& last = stages.back().trajectory;
    return last.at(last.duration()).positions;
  }
};

/// Either a plan or why there is none.
using ManipulationResult = std::variant<ManipulationPlan, MotionFailure>;

} // namespace castor::manipulation
