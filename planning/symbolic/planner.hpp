#pragma once

#include "castor/planning/symbolic/lazy_search.hpp"
#include "castor/planning/symbolic/lifted_task.hpp"
#include "castor/planning/symbolic/limits.hpp"
#include "castor/planning/symbolic/task.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

/// The planner: from a task to a plan, to the proof that there is none, or to neither within
/// limits.
namespace castor::planning {

struct PlanStep {
  /// "stack a b".
  std::string action;
  std::int64_t cost = 1;

  friend bool operator==(const PlanStep&, const PlanStep&) = default;
};

struct PlanningProgress {
  std::size_t expanded = 0;
  double seconds = 0;
  /// Of the best plan so far.
  std::optional<std::int64_t> best_cost;
};

struct PlanningOptions {
  PlanningLimits limits;
  /// Looks for cheaper plans until the limits, or until none can be cheaper.
  bool is_anytime = false;
  /// Called from time to time by the thread that plans; may be empty.
  std::function<void(const PlanningProgress&)> on_progress;
};

struct PlanningResult {
  enum class Outcome : std::uint8_t {
    plan,
    /// Proved: there is no plan.
    unsolvable,
    /// The limits were reached before anything was known.
    unknown
  };

  Outcome outcome = Outcome::unknown;
  std::vector<PlanStep> steps;
  std::int64_t cost = 0;
  /// Proved: no plan costs less.
  bool is_optimal = false;
  /// What ended the search, if it was not at its end.
  std::optional<LimitReached> limit;
  /// Of the task without parameters.
  std::size_t variables = 0;
  std::size_t facts = 0;
  std::size_t operators = 0;
  std::size_t landmarks = 0;
  SearchCounts counts;
  /// Seconds until the task was without parameters, until the first plan, and in all.
  double grounding_seconds = 0;
  double first_plan_seconds = 0;
  double seconds = 0;
};

/// The outcome in words, without the plan: "there is no plan: ...".
std::string explain(const PlanningResult& result);

/// Looks for a plan. Throws nothing but std::bad_alloc.
PlanningResult find_plan(const LiftedTask& task, const PlanningOptions& options);

/// The searched task of a lifted one.
/// \throws LimitError
Task compile(const LiftedTask& lifted, LimitWatch& watch);

/// The plan without actions that it reaches its goal without (Nakhost and Mueller 2010, "action
/// elimination").
OperatorSequence without_needless_actions(const Task& task, const OperatorSequence& plan);

} // namespace castor::planning
