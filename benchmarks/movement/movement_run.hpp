#pragma once

#include "castor/benchmarks/movement/movement_world.hpp"
#include "castor/mapping/movement/goal_pursuit.hpp"
#include "castor/mapping/movement/goal_tally.hpp"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace castor::benchmark {

struct MovementRunOptions {
  int goals = 50;
  /// Goals where the robot fits only.
  bool fitting = true;
  int people = 10;
  /// Of goals, people, slip and noise.
  std::uint64_t seed = 1;
  mapping::BodyOptions body;
  mapping::PursuitOptions pursuit;
  /// An action is given up after that time, seconds.
  double longest = 600;
  /// Called with each scan, the odometry and the true state of the body at its time.
  std::function<void(const mapping::LaserScan&, const mapping::Odometry&,
                     const mapping::BodyStatus&)>
    on_scan = [](auto&...) {};
};

struct MovementRun {
  mapping::GoalTally tally;
  /// Simulated, seconds.
  double time = 0;
  /// Of those that failed, and of collisions.
  std::vector<std::string> remarks;
};

/// GoalPursuit alone, with a simulated body that knows its pose: random goals, one after the other.
/// Takes a small part of the time of the whole system.
MovementRun run_movement(const MovementWorld& world, const MovementRunOptions& options);

} // namespace castor::benchmark
