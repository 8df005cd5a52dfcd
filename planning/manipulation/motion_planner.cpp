#include "castor/planning/manipulation/motion_planner.hpp"

#include "castor/planning/manipulation/kinematics.hpp"
#include "castor/planning/manipulation/sampling_planner.hpp"

#include <algorithm>
#include <stdexcept>

namespace castor::manipulation {

namespace {

void check_limits(const ArmModel& arm, const Configuration& configuration,
                  const std::string& what) {
  if (!within_limits(arm, configuration))
    throw std::invalid_argument(what + " of a motion is beyond the limits of the joints of " +
                                arm.name + ", or of another arm");
}

class Planning {
public:
  Planning(const ArmModel& arm, const Scene& scene, const Configuration& start,
           const std::vector<Configuration>& goals, const MotionPlannerOptions& options)
    : arm_(arm), scene_(scene), start_(start), options_(options), goals_(goals) {
    // The nearest first.
    std::ranges::sort(goals_, {}, [&](const auto& x) { return distance(x, start); });
  }

  MotionResult run(const std::string& destination) {
    CollisionChecker checker(arm_, scene_, options_.collisions);
    if (const auto contact = checker.contact(start_))
      return blocked_start(*contact);
    std::vector<Contact> contacts;
    const auto goals = free_goals(checker, contacts);
    if (goals.empty())
      return blocked_goal(contacts, destination);
    if (auto path = find(checker, goals, options_.time_limit)) {
      path->length = path_length(path->waypoints);
      path->checks = checker.checks();
      return *std::move(path);
    }
    std::vector<std::string> names;
    for (const auto& thing : scene_.things)
      names.push_back(thing.name);
    return blocked_way(names, destination,
                       [this](const auto& taken_away) { return has_way_without(taken_away); });
  }

private:
  std::vector<Configuration> free_goals(CollisionChecker& checker, std::vector<Contact>& contacts) {
    std::vector<Configuration> result;
    for (const auto& goal : goals_)
      if (auto contact = checker.contact(goal))
        contacts.push_back(*std::move(contact));
      else
        result.push_back(goal);
    return result;
  }

  std::optional<JointPath> find(CollisionChecker& checker, const std::vector<Configuration>& goals,
                                double time_limit) {
    // The shortest way of all.
    if (checker.is_free_between(start_, goals.front())) {
      JointPath result;
      result.waypoints = {start_, goals.front()};
      result.found_length = distance(start_, goals.front());
      return result;
    }
    auto result = sample_path(arm_, checker, start_, goals, options_, time_limit);
    if (result || options_.algorithm == PlanningAlgorithm::rrt_connect)
      return result;
    // What looks for short ways may run out of time where there is any.
    auto options = options_;
    options.algorithm = PlanningAlgorithm::rrt_connect;
    return sample_path(arm_, checker, start_, goals, options, time_limit);
  }

  bool has_way_without(const std::vector<std::string>& names) {
    CollisionChecker checker(arm_, without(scene_, names), options_.collisions);
    std::vector<Contact> contacts;
    const auto goals = free_goals(checker, contacts);
    return !goals.empty() && find(checker, goals, options_.explanation_time_limit).has_value();
  }

  const ArmModel& arm_;
  const Scene& scene_;
  const Configuration& start_;
  const MotionPlannerOptions& options_;
  std::vector<Configuration> goals_;
};

} // namespace

MotionResult plan_motion(const ArmModel& arm, const Scene& scene, const Configuration& start,
                         const std::vector<Configuration>& goals, const std::string& destination,
                         const MotionPlannerOptions& options) {
  check_limits(arm, start, "the start");
  if (goals.empty())
    throw std::invalid_argument("a motion to " + destination +
                                " has no goal: InverseKinematics found none");
  for (const auto& goal : goals)
    check_limits(arm, goal, "a goal");
  return Planning(arm, scene, start, goals, options).run(destination);
}

} // namespace castor::manipulation
