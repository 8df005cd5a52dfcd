#pragma once

#include "castor/planning/continual/types.hpp"

#include <string>
#include <vector>

namespace castor::planning {

struct ContinualPlanOptions {
  /// Plans and failures in a row without a step that succeeds, after which a goal is given up.
  int most_in_a_row = 4;
  /// Steps after which a goal is given up.
  int most_steps = 100;
  /// Steps that failed for one goal, whatever succeeded between them.
  int most_failures = 12;
};

/// Decides what is done next for a goal: observe, plan, or act. It gets what came of that, and so
/// on, until the goal is achieved or given up. Has no clock and does nothing itself.
class ContinualPlan {
public:
  /// @param agent that plans
  ContinualPlan(AchieveGoal goal, std::string agent, ContinualPlanOptions options = {});

  /// What to do now: `observing`, `planning`, `acting`, or how it ended.
  PlanPhase phase() const { return status_.phase; }
  bool is_over() const;
  const ContinualPlanning& status() const { return status_; }
  const AchieveGoal& goal() const { return goal_; }

  /// Another goal from now on.
  void change_goal(AchieveGoal goal);
  void cancel(std::string why);

  // -- observing

  /// The objects and facts of all contributors.
  void observed(const std::vector<StateReply>& replies);
  void observation_failed(const std::string& why);
  /// As observed last.
  const PlanningState& state() const { return state_; }

  // -- planning

  FindPlan request() const;
  void planned(const FoundPlan& found);
  void planning_failed(const std::string& why);

  // -- acting

  /// The step to be done now.
  const PlannedStep& step() const { return status_.steps.front(); }
  void succeeded();
  void failed(const std::string& why);

private:
  /// Counts a failure, and gives up after too many.
  void count(const std::string& why);
  void give_up(std::string why);

  AchieveGoal goal_;
  std::string agent_;
  ContinualPlanOptions options_;
  ContinualPlanning status_;
  PlanningState state_;
  std::vector<std::string> learned_;
  /// Not yet told to the planner.
  std::string done_;
  PlanReason reason_ = PlanReason::no_plan_yet;
  std::string why_ = "there is no plan yet";
  int failures_ = 0;
};

} // namespace castor::planning
