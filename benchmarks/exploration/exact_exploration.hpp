#pragma once

#include "castor/mapping/building/building.hpp"
#include "castor/mapping/exploration/exploration_planner.hpp"
#include "castor/mapping/grid/cell_map.hpp"
#include "castor/mapping/movement/path_planner.hpp"

#include <cstdint>
#include <vector>

namespace castor::mapping {

struct ExactExplorationOptions {
  ExplorationOptions exploration;
  PlanOptions plan;
  /// From one scan to the next, metres and radians: those of ScanMatchingFrontEnd.
  double scan_distance = 0.15;
  double scan_turn = 0.12;
  /// Way between two looks at the map, metres.
  double look_period = 0.25;
  /// Velocities that count for the time, m/s and rad/s.
  double speed = 0.45;
  double turn = 1;
  /// It is given up after that way, metres.
  double longest = 2000;
};

struct ExactExploration {
  CellMap map;
  std::vector<Pose2> path;
  /// Metres, and seconds.
  double driven = 0;
  double time = 0;
  std::int64_t goals = 0;
  bool finished = false;
  /// What was not seen.
  std::vector<FrontierReport> left;
};

/// The decisions of the Explorer alone: the laser is exact, the pose is known, and the robot is
/// moved along each planned way. Takes a hundredth of the time of the whole system.
ExactExploration explore_exactly(const Building& building,
                                 const ExactExplorationOptions& options = {});

} // namespace castor::mapping
