#include "castor/planning/continual/continual_plan.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace castor::planning {

namespace {

std::vector<std::string> without(const std::vector<std::string>& x,
                                 const std::vector<std::string>& y) {
  std::vector<std::string> result;
  std::ranges::set_difference(x, y, std::back_inserter(result));
  return result;
}

void add_objects(std::vector<StateObject>& objects, const std::vector<StateObject>& added) {
  for (const auto& x : added)
    if (std::ranges::find(objects, x) == objects.end())
      objects.push_back(x);
}

} // namespace

ContinualPlan::ContinualPlan(AchieveGoal goal, std::string agent, ContinualPlanOptions options)
  : goal_(std::move(goal)), agent_(std::move(agent)), options_(options) {
  status_.goal = goal_.goal;
}

bool ContinualPlan::is_over() const {
  return phase() == PlanPhase::achieved || phase() == PlanPhase::given_up ||
         phase() == PlanPhase::cancelled;
}

void ContinualPlan::change_goal(AchieveGoal goal) {
  goal_ = std::move(goal);
  status_.goal = goal_.goal;
  status_.phase = PlanPhase::observing;
  reason_ = PlanReason::goal_changed;
  why_ = "the goal has changed";
}

void ContinualPlan::cancel(std::string why) {
  status_.phase = PlanPhase::cancelled;
  status_.why = std::move(why);
}

void ContinualPlan::observed(const std::vector<StateReply>& replies) {
  PlanningState next;
  next.objects = goal_.objects;
  next.facts = goal_.facts;
  for (const auto& x : replies) {
    add_objects(next.objects, x.objects);
    next.facts.insert(next.facts.end(), x.facts.begin(), x.facts.end());
  }
  std::ranges::sort(next.facts);
  next.facts.erase(std::unique(next.facts.begin(), next.facts.end()), next.facts.end());
  next.became_true = without(next.facts, state_.facts);
  next.became_false = without(state_.facts, next.facts);
  state_ = std::move(next);
  status_.phase = PlanPhase::planning;
}

void ContinualPlan::observation_failed(const std::string& why) {
  count(why);
}

FindPlan ContinualPlan::request() const {
  FindPlan result;
  result.goal = goal_.goal;
  result.agent = agent_;
  result.objects = state_.objects;
  result.facts = state_.facts;
  result.learned = learned_;
  result.steps = status_.steps;
  result.done = done_;
  result.reason = reason_;
  result.why = why_;
  return result;
}

void ContinualPlan::planned(const FoundPlan& found) {
  learned_ = found.learned;
  done_.clear();
  const auto because = [&](const std::string& text) {
    return found.why.empty() || found.reason == PlanReason::no_plan_yet
             ? text
             : text + ", after " + found.why;
  };
  switch (found.outcome) {
    case PlanOutcome::achieved:
      status_.phase = PlanPhase::achieved;
      status_.steps.clear();
      status_.why = found.explanation;
      return;
    case PlanOutcome::kept:
      status_.phase = PlanPhase::acting;
      return;
    case PlanOutcome::unsolvable:
      return give_up(because(found.explanation));
    case PlanOutcome::refused:
      return give_up("the goal or the state cannot be understood: " + found.explanation);
    case PlanOutcome::unknown:
      return count(because(found.explanation));
    case PlanOutcome::changed:
      break;
  }
  status_.plans.push_back({found.reason, found.why, found.steps});
  status_.steps = found.steps;
  reason_ = PlanReason::none;
  why_.clear();
  if (found.reason != PlanReason::no_plan_yet && found.reason != PlanReason::goal_changed)
    count(found.why);
  if (!is_over())
    status_.phase = PlanPhase::acting;
}

void ContinualPlan::planning_failed(const std::string& why) {
  count(why);
}

void ContinualPlan::succeeded() {
  done_ = step().action;
  status_.done.push_back(done_);
  status_.steps.erase(status_.steps.begin());
  status_.in_a_row = 0;
  status_.phase = PlanPhase::observing;
  if (status_.steps.empty()) {
    reason_ = PlanReason::state_changed;
    why_ = "all steps were done, and the goal does not hold";
  }
  if (status_.done.size() >= static_cast<std::size_t>(options_.most_steps))
    give_up("the goal does not hold after " + std::to_string(options_.most_steps) + " steps");
}

void ContinualPlan::failed(const std::string& why) {
  reason_ = PlanReason::action_failed;
  why_ = "'" + step().action + "' failed: " + why;
  status_.phase = PlanPhase::observing;
  // That a place is chosen, which always succeeds, is no progress.
  if (++failures_ >= options_.most_failures)
    give_up("it failed " + std::to_string(failures_) + " times, the last time because " + why_);
}

void ContinualPlan::count(const std::string& why) {
  status_.phase = PlanPhase::observing;
  if (++status_.in_a_row > options_.most_in_a_row)
    give_up("it failed " + std::to_string(status_.in_a_row) +
            " times in a row without a step that succeeded, the last time because " + why);
}

void ContinualPlan::give_up(std::string why) {
  status_.phase = PlanPhase::given_up;
  status_.steps.clear();
  status_.why = std::move(why);
}

} // namespace castor::planning
