#include "castor/planning/symbolic/planner.hpp"

#include "castor/planning/symbolic/invariants.hpp"
#include "castor/planning/symbolic/relevance.hpp"

#include <algorithm>
#include <array>
#include <new>
#include <optional>
#include <utility>

namespace castor::planning {

namespace {

/// Weights of the improving searches, as LAMA (Richter and Westphal 2010).
constexpr std::array<int, 4> weights{5, 3, 2, 1};

/// Weights of the short searches that follow the first plan; nothing for greedy search.
constexpr std::array<std::optional<int>, 3> other_weights{std::nullopt, 5, 2};

/// States that each of them may expand, beside as many as before the first plan.
constexpr std::size_t least_further = 1000;

std::int64_t cost_of(const Task& task, const OperatorSequence& plan) {
  std::int64_t result = 0;
  for (const int x : plan)
    result += task.operators[static_cast<std::size_t>(x)].cost;
  return result;
}

class Planner {
public:
  Planner(const LiftedTask& lifted, const PlanningOptions& options)
    : lifted_(lifted), options_(options), watch_(options.limits) {
    // nop
  }

  PlanningResult run() {
    try {
      plan();
    } catch (const LimitError& e) {
      result_.limit = e.limit();
    } catch (const std::bad_alloc&) {
      result_.limit = LimitReached::memory;
    }
    result_.seconds = watch_.seconds();
    return std::move(result_);
  }

private:
  void plan() {
    const auto task = compile(lifted_, watch_);
    result_.grounding_seconds = watch_.seconds();
    result_.variables = task.domain_sizes.size();
    result_.facts = task.fact_count();
    result_.operators = task.operators.size();
    if (task.is_unreachable) {
      result_.outcome = PlanningResult::Outcome::unsolvable;
      return;
    }
    const SuccessorGenerator successors(task, watch_);
    const LandmarkCount landmarks(task, find_landmarks(task, watch_));
    result_.landmarks = landmarks.size();
    search(task, successors, landmarks);
  }

  /// Keeps the plan that the search finds. True if it shows that no other plan costs less.
  bool search_once(const Task& task, const SuccessorGenerator& successors,
                   const LandmarkCount& landmarks, SearchOptions options) {
    if (result_.outcome == PlanningResult::Outcome::plan)
      options.bound = result_.cost;
    const auto found = search_lazily(task, successors, landmarks, options, watch_, result_.counts,
                                     [this](const SearchCounts&) { report(); });
    if (!found.plan)
      return found.is_exhausted;
    const auto plan = without_needless_actions(task, *found.plan);
    if (result_.outcome != PlanningResult::Outcome::plan)
      result_.first_plan_seconds = watch_.seconds();
    result_.outcome = PlanningResult::Outcome::plan;
    result_.cost = cost_of(task, plan);
    result_.steps.clear();
    for (const int x : plan) {
      const auto& op = task.operators[static_cast<std::size_t>(x)];
      result_.steps.push_back({op.name, op.cost});
    }
    report();
    return false;
  }

  void search(const Task& task, const SuccessorGenerator& successors,
              const LandmarkCount& landmarks) {
    if (search_once(task, successors, landmarks, {})) {
      result_.outcome = PlanningResult::Outcome::unsolvable;
      return;
    }
    SearchOptions options;
    options.cost_count = has_unit_costs(task) ? CostCount::one : CostCount::plus_one;
    // Searches that go other ways may find a cheaper plan soon.
    options.most_expanded = least_further + result_.counts.expanded;
    for (const auto& weight : other_weights)
      for (const bool has_landmarks : {false, true}) {
        options.weight = weight;
        options.has_landmarks = has_landmarks;
        result_.is_optimal =
          result_.is_optimal || search_once(task, successors, landmarks, options);
      }
    if (!options_.is_anytime)
      return;
    options.most_expanded = SearchOptions().most_expanded;
    options.has_landmarks = true;
    for (std::size_t i = 0; !result_.is_optimal; ++i) {
      options.weight = weights[std::min(i, weights.size() - 1)];
      result_.is_optimal = search_once(task, successors, landmarks, options);
    }
  }

  void report() const {
    if (!options_.on_progress)
      return;
    PlanningProgress progress{result_.counts.expanded, watch_.seconds(), {}};
    if (result_.outcome == PlanningResult::Outcome::plan)
      progress.best_cost = result_.cost;
    options_.on_progress(progress);
  }

  const LiftedTask& lifted_;
  const PlanningOptions& options_;
  LimitWatch watch_;
  PlanningResult result_;
};

} // namespace

Task compile(const LiftedTask& lifted, LimitWatch& watch) {
  auto normal = normalise(lifted);
  remove_irrelevant(normal);
  const auto ground_task = ground(lifted, normal, watch);
  return make_task(lifted, normal, ground_task, find_mutex_groups(ground_task, watch), watch);
}

OperatorSequence without_needless_actions(const Task& task, const OperatorSequence& plan) {
  OperatorSequence result = plan;
  for (std::size_t i = 0; i < result.size();) {
    OperatorSequence kept(result.begin(), result.begin() + static_cast<std::ptrdiff_t>(i));
    State state = task.initial;
    State next;
    for (const int x : kept) {
      apply(task, task.operators[static_cast<std::size_t>(x)], state, next);
      std::swap(state, next);
    }
    // Without this action, and then without those that are not applicable any more.
    for (auto k = i + 1; k < result.size(); ++k) {
      const auto& op = task.operators[static_cast<std::size_t>(result[k])];
      if (!holds(op.precondition, state))
        continue;
      apply(task, op, state, next);
      std::swap(state, next);
      kept.push_back(result[k]);
    }
    if (holds(task.goal, state))
      result = std::move(kept);
    else
      ++i;
  }
  return result;
}

PlanningResult find_plan(const LiftedTask& task, const PlanningOptions& options) {
  return Planner(task, options).run();
}

std::string explain(const PlanningResult& result) {
  const auto expanded = std::to_string(result.counts.expanded) + " expanded states";
  switch (result.outcome) {
    case PlanningResult::Outcome::plan:
      return "plan of " + std::to_string(result.steps.size()) + " actions with cost " +
             std::to_string(result.cost) + (result.is_optimal ? ", and none costs less" : "");
    case PlanningResult::Outcome::unsolvable:
      return result.counts.expanded == 0
               ? "there is no plan: the goal cannot be reached, even if no action deletes anything"
               : "there is no plan: all states that can be reached were looked at, " + expanded;
    case PlanningResult::Outcome::unknown:
      break;
  }
  return "no plan was found within the limits, after " + expanded + ": " +
         (result.limit ? to_string(*result.limit) : "unknown");
}

} // namespace castor::planning
