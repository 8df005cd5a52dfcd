#pragma once

#include "castor/planning/body/arm_body.hpp"
#include "castor/planning/manipulation/manipulation_plan.hpp"
#include "castor/planning/manipulation/motion_window.hpp"
#include "castor/tests/planning/manipulation/katana.hpp"

#include <chrono>
#include <functional>
#include <numbers>
#include <utility>
#include <vector>

namespace castor::manipulation {

inline constexpr double degree = std::numbers::pi / 180;

/// Where the arm does not reach over the table.
inline Configuration aside() {
  return {90 * degree, -20 * degree, 110 * degree, 60 * degree, 90 * degree};
}

inline TableWorld table_with(const std::vector<NamedSolid>& things) {
  TableWorld result(table_top(2, 2));
  for (const auto& x : things)
    result.add(x);
  return result;
}

/// Lets the arm carry out a stage as an executor does, with a command every 40 ms; false if it does
/// not come to its end within a minute.
inline bool carry_out(ArmBody& body, const MotionStage& stage, std::int64_t motion,
                      const std::function<void()>& after_step = {}) {
  using namespace std::chrono_literals;
  for (int i = 0; i < 6000; ++i) {
    if (i % 4 == 0) {
      const auto state = body.state();
      const double time = state.motion == motion ? state.motion_time : 0;
      auto command = motion_window(stage.trajectory, motion, time);
      command.opening = stage.opening;
      command.pushes = stage.pushes;
      body.command(command, 300ms);
    }
    body.step();
    if (after_step)
      after_step();
    const auto state = body.state();
    if (!state.fault.empty())
      return false;
    if (state.motion_time >= stage.trajectory.duration() && state.rests && i > 0)
      return !stage.holds || *stage.holds == state.holds;
  }
  return false;
}

/// A motion of the joints, on a straight line.
inline MotionStage motion(const ArmModel& arm, const Configuration& from, const Configuration& to,
                          double opening = 0.1) {
  const BlendedPath path({from, to}, {0, 0});
  return {ManipulationStatus::moving, "", time_parameterise(arm, path, {0.01, 0.6, 0.5, 0.2}),
          opening};
}

} // namespace castor::manipulation
