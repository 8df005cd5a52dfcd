#include "castor/planning/manipulation/sampling_planner.hpp"

#include <ompl/base/goals/GoalStates.h>
#include <ompl/base/objectives/PathLengthOptimizationObjective.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/geometric/SimpleSetup.h>
#include <ompl/geometric/planners/informedtrees/BITstar.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/geometric/planners/rrt/RRTstar.h>
#include <ompl/util/Console.h>
#include <ompl/util/RandomNumbers.h>

#include <mutex>

namespace castor::manipulation {

namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;

/// OMPL has one generator of seeds for all threads.
std::mutex& seeding() {
  static std::mutex mutex;
  return mutex;
}

ob::PlannerPtr planner(PlanningAlgorithm algorithm, const ob::SpaceInformationPtr& space) {
  switch (algorithm) {
    case PlanningAlgorithm::rrt_star:
      return std::make_shared<og::RRTstar>(space);
    case PlanningAlgorithm::bit_star:
      return std::make_shared<og::BITstar>(space);
    default:
      return std::make_shared<og::RRTConnect>(space);
  }
}

std::shared_ptr<ob::RealVectorStateSpace> joint_space(const ArmModel& arm) {
  const auto moving = moving_joints(arm);
  const auto size = static_cast<unsigned>(moving.size());
  ob::RealVectorBounds bounds(size);
  for (unsigned i = 0; i < size; ++i) {
    const auto& joint = arm.joints[moving[i]];
    // It refuses bounds that are equal.
    const double room = stands_still(joint) ? 1e-10 : 0;
    bounds.setLow(i, joint.lower - room);
    bounds.setHigh(i, joint.upper + room);
  }
  auto result = std::make_shared<ob::RealVectorStateSpace>(size);
  result->setBounds(bounds);
  return result;
}

std::span<const double> values(const ob::State* state, std::size_t size) {
  return {state->as<ob::RealVectorStateSpace::StateType>()->values, size};
}

ob::ScopedState<ob::RealVectorStateSpace>
to_state(const std::shared_ptr<ob::RealVectorStateSpace>& space,
         const Configuration& configuration) {
  ob::ScopedState<ob::RealVectorStateSpace> result(space);
  std::ranges::copy(configuration, result->values);
  space->enforceBounds(result.get());
  return result;
}

std::vector<Configuration> waypoints_of(og::PathGeometric& path, std::size_t size) {
  std::vector<Configuration> result;
  for (const auto* state : path.getStates()) {
    const auto numbers = values(state, size);
    result.emplace_back(numbers.begin(), numbers.end());
  }
  return result;
}

bool is_free(CollisionChecker& checker, const std::vector<Configuration>& waypoints) {
  for (std::size_t i = 1; i < waypoints.size(); ++i)
    if (!checker.is_free_between(waypoints[i - 1], waypoints[i]))
      return false;
  return true;
}

} // namespace

std::optional<JointPath> sample_path(const ArmModel& arm, CollisionChecker& checker,
                                     const Configuration& start,
                                     const std::vector<Configuration>& goals,
                                     const MotionPlannerOptions& options, double time_limit) {
  const std::lock_guard lock(seeding());
  // It calls it an error to set a seed again; samplers that are made from now on take it.
  ompl::msg::setLogLevel(ompl::msg::LOG_NONE);
  ompl::RNG::setSeed(options.seed);

  const auto space = joint_space(arm);
  og::SimpleSetup setup(space);
  setup.setStateValidityChecker([&checker, size = start.size()](const ob::State* state) {
    return checker.is_free(values(state, size));
  });
  const auto& information = setup.getSpaceInformation();
  // A share of the space's extent.
  information->setStateValidityCheckingResolution(checker.step() / space->getMaximumExtent());
  setup.setPlanner(planner(options.algorithm, information));
  setup.setOptimizationObjective(
    std::make_shared<ob::PathLengthOptimizationObjective>(information));
  setup.setStartState(to_state(space, start));
  const auto states = std::make_shared<ob::GoalStates>(information);
  for (const auto& goal : goals)
    states->addState(to_state(space, goal).get());
  setup.setGoal(states);

  // An approximate solution, which does not reach the goal, would count as true.
  if (setup.solve(time_limit) != ob::PlannerStatus::EXACT_SOLUTION)
    return {};
  JointPath result;
  result.waypoints = waypoints_of(setup.getSolutionPath(), start.size());
  result.found_length = path_length(result.waypoints);
  // OMPL takes 0 for no limit.
  if (options.simplification_time_limit > 0)
    setup.simplifySolution(options.simplification_time_limit);
  if (auto shorter = waypoints_of(setup.getSolutionPath(), start.size()); is_free(checker, shorter))
    result.waypoints = std::move(shorter);
  return result;
}

} // namespace castor::manipulation
