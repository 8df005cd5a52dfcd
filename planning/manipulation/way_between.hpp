#pragma once

#include "castor/planning/manipulation/manipulation_planner.hpp"

#include <optional>
#include <string>
#include <vector>

namespace castor::manipulation {

/// Where no grasp of a thing fits both where it is and where it is to be, it is put down between,
/// to be grasped in another way: the plan to put it at the first of the places from which it can
/// be put at its goal, or else, where it can be turned so that it can then. Nothing if there is
/// none.
/// @param places in the arm's frame, on the table
/// \throws std::invalid_argument if there is no such thing in the scene.
std::optional<ManipulationPlan> plan_way_between(const ManipulationPlanner& planner,
                                                 const Scene& scene, const std::string& thing,
                                                 const PlaceGoal& goal,
                                                 const std::vector<Point3>& places,
                                                 const Configuration& start);

} // namespace castor::manipulation
