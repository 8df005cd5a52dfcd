#pragma once

#include "castor/actors/component/entry_pointer.hpp"
#include "castor/wm/values/reflect.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

/// Entry types of continual planning: what is asked of contributors and executors, and how far a
/// goal is. Facts, goals and conditions are in PDDL or MAPL (docs/planning.md), names in lower
/// case.
namespace castor::planning {

struct StateObject {
  std::string name;
  std::string type;

  friend bool operator==(const StateObject&, const StateObject&) = default;
};

/// A call to each contributor: what does it know of the world now? Replied to by a StateReply.
struct StateRequest {
  /// What is to be reached.
  std::string goal;
};

/// What a contributor knows. An object that several contributors know has the same type for all.
struct StateReply {
  std::vector<StateObject> objects;
  /// "(= (is-in robby) hall)".
  std::vector<std::string> facts;
};

/// Action: reach the goal, whatever happens meanwhile. If it is overwritten with another one, that
/// is reached instead, from the end of the step that runs.
struct AchieveGoal {
  /// "(K ann (perceived-position book))".
  std::string goal;
  /// Known for this goal alone, beside what contributors say.
  std::vector<StateObject> objects = {};
  std::vector<std::string> facts = {};

  friend bool operator==(const AchieveGoal&, const AchieveGoal&) = default;
};

/// Action: one step of a plan, for the executor of such steps. It ends when its effects can be
/// asked for.
struct PlannedAction {
  std::string name;
  /// Objects, the acting agent first.
  std::vector<std::string> arguments;
};

enum class StepKind : std::uint8_t { action, sensor, assertion };
CASTOR_REFLECT_ENUM(StepKind, action, sensor, assertion)

struct PlannedStep {
  /// "move robby kitchen hall".
  std::string action;
  StepKind kind = StepKind::action;
  std::int64_t cost = 1;

  friend bool operator==(const PlannedStep&, const PlannedStep&) = default;
};

/// The state as it was put together.
struct PlanningState {
  std::vector<StateObject> objects;
  std::vector<std::string> facts;
  /// By which it differs from the one before.
  std::vector<std::string> became_true;
  std::vector<std::string> became_false;
};

/// Why a plan is made.
enum class PlanReason : std::uint8_t {
  none,
  no_plan_yet,
  /// The plan does not lead to the goal from here.
  state_changed,
  goal_changed,
  /// What an assertion of the plan waits for is known now.
  assertion_enabled,
  action_failed
};
CASTOR_REFLECT_ENUM(PlanReason, none, no_plan_yet, state_changed, goal_changed, assertion_enabled,
                    action_failed)

/// Action: keep the steps if they still lead to the goal, else find others. The result is a
/// FoundPlan with the id of the action, in the planner's working memory, for a minute.
struct FindPlan {
  std::string goal;
  std::string agent;
  std::vector<StateObject> objects;
  std::vector<std::string> facts;
  /// What sensors have shown not to be so: predicates and objects, as the planner told.
  std::vector<std::string> learned;
  /// Still to be done; empty if there is no plan.
  std::vector<PlannedStep> steps;
  /// Done since the last time; empty if nothing was.
  std::string done;
  /// Why the steps are not to be kept, in any case; `none` if they may be.
  PlanReason reason = PlanReason::none;
  /// The same in words.
  std::string why;
};

enum class PlanOutcome : std::uint8_t {
  /// The goal holds.
  achieved,
  /// The steps are kept.
  kept,
  changed,
  unsolvable,
  /// Nothing was found within the limits.
  unknown,
  /// The goal or a fact cannot be understood.
  refused
};
CASTOR_REFLECT_ENUM(PlanOutcome, achieved, kept, changed, unsolvable, unknown, refused)

struct FoundPlan {
  PlanOutcome outcome = PlanOutcome::unknown;
  std::vector<PlannedStep> steps;
  /// Why the steps before were not kept, and in words.
  PlanReason reason = PlanReason::none;
  std::string why;
  /// Of FindPlan, and what has been learned by the step that was done.
  std::vector<std::string> learned;
  /// The outcome in words.
  std::string explanation;
};

/// How far a planner is; one such entry for each planner, overwritten while it plans.
struct PlannerProgress {
  bool is_planning = false;
  std::uint64_t expanded = 0;
  double seconds = 0;
  /// Of the best plan so far.
  std::optional<std::int64_t> best_cost = {};
};

enum class PlanPhase : std::uint8_t { observing, planning, acting, achieved, given_up, cancelled };
CASTOR_REFLECT_ENUM(PlanPhase, observing, planning, acting, achieved, given_up, cancelled)

/// A plan that was made for a goal.
struct MadePlan {
  PlanReason reason = PlanReason::none;
  std::string why;
  std::vector<PlannedStep> steps;

  friend bool operator==(const MadePlan&, const MadePlan&) = default;
};

/// How far a goal is.
struct ContinualPlanning {
  std::string goal;
  PlanPhase phase = PlanPhase::observing;
  /// Still to be done, the one that is being done first.
  std::vector<PlannedStep> steps;
  std::vector<std::string> done;
  /// All plans so far.
  std::vector<MadePlan> plans;
  /// How it ended, and why; empty before that.
  std::string why;
  /// Plans and failures in a row without a step that succeeded.
  std::int32_t in_a_row = 0;
  /// The `PlanningState` that it rests on.
  EntryPointer<PlanningState> state;
};

CASTOR_REFLECT(StateObject, name, type)
CASTOR_REFLECT(StateRequest, goal)
CASTOR_REFLECT(StateReply, objects, facts)
CASTOR_REFLECT(AchieveGoal, goal, objects, facts)
CASTOR_REFLECT(PlannedAction, name, arguments)
CASTOR_REFLECT(PlannedStep, action, kind, cost)
CASTOR_REFLECT(PlanningState, objects, facts, became_true, became_false)
CASTOR_REFLECT(FindPlan, goal, agent, objects, facts, learned, steps, done, reason, why)
CASTOR_REFLECT(FoundPlan, outcome, steps, reason, why, learned, explanation)
CASTOR_REFLECT(PlannerProgress, is_planning, expanded, seconds, best_cost)
CASTOR_REFLECT(MadePlan, reason, why, steps)
CASTOR_REFLECT(ContinualPlanning, goal, phase, steps, done, plans, why, in_a_row, state)

} // namespace castor::planning
