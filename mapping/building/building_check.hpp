#pragma once

#include "castor/mapping/building/building.hpp"

#include <string>
#include <vector>

namespace castor::mapping {

/// Radius and height of the robots that buildings are checked for, metres.
inline constexpr double checked_robot_radius = 0.25;
inline constexpr double checked_robot_height = 0.5;

/// A finding in a building.
struct BuildingRemark {
  bool is_error = true;
  /// Of the building's file; 0 for the whole file.
  int line = 0;
  std::string message;
  std::string remedy;
};

/// Finds the walls that the doors are in and the outlines of the rooms, and reports what is wrong
/// in the building: doors that are in no wall or do not fit into it, rooms that are not closed or
/// that are one, a start where the robot does not fit, names that are given twice; as warnings,
/// things outside of the rooms and people who walk through walls.
std::vector<BuildingRemark> complete_building(Building& x);

} // namespace castor::mapping
