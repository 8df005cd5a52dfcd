#pragma once

#include "castor/planning/manipulation/manipulation_planner.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace castor::manipulation {

/// Places where a thing can be put down on its way, to be grasped there in another way, where no
/// grasp of it fits both where it is and where it is to be. They are found when they are needed for
/// the first time, and kept for further goals.
class StopsBetween {
public:
  /// @param planner has to outlive it
  /// @param places in the arm's frame, on the table
  /// \throws std::invalid_argument if there is no such thing in the scene.
  StopsBetween(const ManipulationPlanner& planner, Scene scene, std::string thing,
               const std::vector<Point3>& places, Configuration start);

  /// Whether it is for that.
  bool are_for(const Scene& scene, const std::string& thing, const Configuration& start) const;

  /// The plan to put the thing at the first of the places from which it can be put at its goal, or
  /// else, where it can be turned so that it can then, perhaps with a further stop. Nothing if
  /// there is none.
  std::optional<ManipulationPlan> plan_to(const PlaceGoal& goal);

  /// Whether there is such a place, without further ones before it; the motions there are not
  /// planned.
  bool reach(const PlaceGoal& goal);

  /// The thing's ways where it stands.
  const ManipulationPlanner::WaysToTake& ways_from_here();

private:
  /// The thing, put down at a place, and the ways to take it there.
  struct Stop {
    PlaceGoal place;
    /// Index of the stop at which it is put down before.
    std::optional<std::size_t> before = {};
    bool is_tried = false;
    /// How it stands there; neither if it cannot be put there.
    std::optional<Pose> pose = {};
    std::optional<ManipulationPlanner::WaysToTake> ways = {};
  };

  const std::optional<ManipulationPlanner::WaysToTake>& ways_from(std::size_t index);
  ManipulationPlanner::WaysToTake ways_at(const Pose& pose) const;
  bool lands_from(std::size_t index, const PlaceGoal& goal);
  bool lands_surely_from(std::size_t index, const PlaceGoal& goal) const;
  const PlaceGoal& first_place(const Stop& stop) const;

  const ManipulationPlanner& planner_;
  Scene scene_;
  std::string thing_;
  Configuration start_;
  /// Where it stands.
  std::optional<ManipulationPlanner::WaysToTake> here_;
  std::vector<Stop> stops_;
};

} // namespace castor::manipulation
