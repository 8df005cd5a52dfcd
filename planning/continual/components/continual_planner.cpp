#include "castor/actors/component/managed_component.hpp"
#include "castor/actors/component/registry.hpp"
#include "castor/planning/continual/continual_plan.hpp"
#include "castor/planning/continual/executors.hpp"
#include "castor/planning/continual/types.hpp"
#include "castor/wm/entries/failure.hpp"

#include <chrono>
#include <cstdint>
#include <deque>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace castor::planning {

namespace {

using namespace std::chrono_literals;

PlannedAction action_of(const PlannedStep& step) {
  PlannedAction result;
  std::istringstream words(step.action);
  words >> result.name;
  for (std::string word; words >> word;)
    result.arguments.push_back(word);
  return result;
}

/// Reaches goals, one after the other, for whoever asks for the action AchieveGoal: plans, has each
/// step executed, and looks at the state again after it.
class ContinualPlanner final : public ManagedComponent {
  void configure() override { executors_ = Executors(executor_options_.get(), executor_.get()); }

  void start() override {
    on_action<AchieveGoal>(
      [this](ActionInProgress& action, const AchieveGoal& goal) { return achieve(action, goal); },
      {.can_pause = true});
  }

  ActionResult achieve(ActionInProgress& action, const AchieveGoal& goal) {
    ContinualPlanOptions options;
    options.most_in_a_row = static_cast<int>(replan_.get());
    options.most_steps = static_cast<int>(most_steps_.get());
    options.most_failures = static_cast<int>(most_failures_.get());
    ContinualPlan plan(goal, agent_, options);
    status_ = here(action.address().id + " goal");
    state_ = here(action.address().id + " state");
    goal_ = read<Action>(action.address())->what.address;
    while (!plan.is_over()) {
      tell(plan);
      // Paused between steps.
      if (!action.wait_while_paused())
        plan.cancel("nobody wants the goal any more");
      else if (plan.phase() == PlanPhase::observing)
        observe(action, plan);
      else if (plan.phase() == PlanPhase::planning)
        find(action, plan);
      else
        act(action, plan);
    }
    tell(plan);
    forget_old();
    switch (plan.phase()) {
      case PlanPhase::achieved:
        return {ActionOutcome::succeeded,
                plan.status().done.empty() ? "it is so already" : "",
                {plan.goal().goal},
                {}};
      case PlanPhase::cancelled:
        return ActionResult::cancelled(plan.status().why);
      default:
        return ActionResult::failed(plan.status().why);
    }
  }

  /// The requester may have overwritten it.
  void follow_goal(ContinualPlan& plan) {
    try {
      const auto goal = read<AchieveGoal>(goal_);
      if (!(*goal == plan.goal()))
        plan.change_goal(*goal);
    } catch (const WorkingMemoryException& e) {
      // The action will be cancelled, or goes on without its requester.
      debug("{}", e.what());
    }
  }

  void observe(ActionInProgress& action, ContinualPlan& plan) {
    follow_goal(plan);
    std::vector<StateReply> replies;
    const auto given_up = now() + outage_.get();
    for (const auto& name : contributors_.get()) {
      std::string failure;
      while (!ask(name, plan, replies, failure))
        // Whoever it asks itself may be started again just now.
        if (now() >= given_up || !action.sleep_for(std::chrono::milliseconds{200}))
          return plan.observation_failed(name + " did not say what it knows: " + failure);
    }
    plan.observed(replies);
  }

  /// Asks a contributor for what it knows; false, and why, if it does not say.
  bool ask(const std::string& name, const ContinualPlan& plan, std::vector<StateReply>& replies,
           std::string& failure) {
    try {
      replies.push_back(
        call<StateRequest, StateReply>(name, {plan.status().goal}, {.timeout = patience_.get()}));
      return true;
    } catch (const WorkingMemoryException& e) {
      failure = e.what();
      return false;
    }
  }

  /// Waits until the action that was asked for is over; false if this one is to end before.
  bool await(ActionInProgress& action, const ActionHandle& asked) {
    const auto is_over = [&asked] { return asked.is_over(); };
    const auto accepted_by = now() + patience_.get();
    bool is_accepted = false;
    while (!is_over()) {
      const auto at_most = is_accepted ? std::chrono::nanoseconds::max()
                                       : std::chrono::nanoseconds{accepted_by - now()};
      if (!action.wait_until(is_over, at_most)) {
        asked.cancel();
        return false;
      }
      // One that nobody accepts is over when it is cancelled.
      if (!is_accepted && now() >= accepted_by && !is_over()) {
        is_accepted = asked.status() != ActionStatus::proposed;
        if (!is_accepted)
          asked.cancel();
      }
    }
    return true;
  }

  void find(ActionInProgress& action, ContinualPlan& plan) {
    try {
      const auto asked = perform(planner_of(), plan.request(), {.cause = cause()});
      if (!await(action, asked))
        return plan.cancel("nobody wants the goal any more");
      const auto state = asked.state();
      if (state.outcome != ActionOutcome::succeeded)
        return plan.planning_failed("the planner failed: " + state.reason);
      plan.planned(*read<FoundPlan>({planner_of(), asked.address().id + " plan"}));
    } catch (const WorkingMemoryException& e) {
      plan.planning_failed(std::string("the planner failed: ") + e.what());
    }
  }

  void act(ActionInProgress& action, ContinualPlan& plan) {
    const auto what = action_of(plan.step());
    const auto executor = executors_.executor_of(what.name);
    try {
      const auto asked = perform(executor, what, {.cause = cause()});
      if (!await(action, asked)) {
        // Its executor ends it safely.
        const auto end = asked.wait(safe_end_.get());
        return plan.cancel("nobody wants the goal any more; the last step: " + end.reason);
      }
      const auto state = asked.state();
      if (state.outcome == ActionOutcome::succeeded)
        plan.succeeded();
      else if (state.executor.empty())
        plan.failed("nobody in '" + executor + "' executes PlannedAction");
      else
        plan.failed(state.reason);
    } catch (const WorkingMemoryException& e) {
      plan.failed(e.what());
    }
  }

  std::string planner_of() const {
    return planner_.get().empty() ? subarchitecture() : std::string(planner_.get());
  }

  AnyEntryPointer cause() const { return {status_, type_name<ContinualPlanning>()}; }

  /// Entries of goals that are over are kept for a while, for people to look at.
  void forget_old() {
    over_.insert(over_.end(), {status_, state_});
    for (; over_.size() > 2 * static_cast<std::size_t>(keep_.get()); over_.pop_front())
      if (exists(over_.front()))
        delete_entry(over_.front());
  }

  void tell(const ContinualPlan& plan) {
    put(state_, plan.state());
    auto status = plan.status();
    status.state = {state_};
    put(status_, std::move(status));
  }

  Option<std::string> agent_{this, "agent", "robot", "name of the agent that plans"};
  Option<std::vector<std::string>> contributors_{
    this, "contributors", {}, "subarchitectures that are asked what they know"};
  Option<SubarchitectureName> executor_{this, "executor", "",
                                        "the subarchitecture that executes steps"};
  Option<std::vector<std::string>> executor_options_{
    this, "executors", {}, "others for some actions: move=navigation,ask-*=communication"};
  Option<SubarchitectureName> planner_{this, "planner", "",
                                       "the planner's subarchitecture; empty for this one"};
  Option<std::int64_t> replan_{this, "replan", 4,
                               "plans and failures in a row, after which it gives up"};
  Option<std::int64_t> most_steps_{this, "most-steps", 100,
                                   "steps for one goal, after which it gives up"};
  Option<std::int64_t> most_failures_{this, "most-failures", 12,
                                      "steps that fail for one goal, after which it gives up"};
  Option<std::int64_t> keep_{this, "keep", 20, "goals that are over whose entries it keeps"};
  Option<std::chrono::milliseconds> outage_{
    this, "outage", std::chrono::seconds{5},
    "how long a contributor that fails is asked again, before that counts as a failure"};
  Option<std::chrono::milliseconds> patience_{
    this, "patience", 2s, "how long it waits for a contributor, and for a step to be accepted"};
  Option<std::chrono::milliseconds> safe_end_{this, "safe-end", 10s,
                                              "how long it waits for a cancelled step to end"};

  Executors executors_;
  /// Of the AchieveGoal that is being executed, its status and its state.
  Address goal_;
  Address status_;
  Address state_;
  std::deque<Address> over_;
};

CASTOR_COMPONENT(ContinualPlanner, "reaches goals by plans, whatever happens meanwhile")

} // namespace

} // namespace castor::planning
