#include "castor/planning/symbolic/relaxed_plan_heuristic.hpp"

#include <algorithm>
#include <functional>
#include <utility>

namespace castor::planning {

namespace {

/// Costs of facts are sums that may grow exponentially.
constexpr int most_fact_cost = 1'000'000'000;

/// Costs below this have a bucket each; a heap is for larger ones.
constexpr std::size_t bucket_count = 512;

} // namespace

std::int64_t counted_cost(const TaskOperator& op, CostCount count) {
  switch (count) {
    case CostCount::one:
      return 1;
    case CostCount::plus_one:
      return op.cost + 1;
    case CostCount::real:
      break;
  }
  return op.cost;
}

bool has_unit_costs(const Task& task) {
  return std::ranges::all_of(task.operators, [](const TaskOperator& x) { return x.cost == 1; });
}

RelaxedPlanHeuristic::RelaxedPlanHeuristic(const Task& task, CostCount count)
  : task_(task), facts_(task.fact_count()), buckets_(bucket_count),
    is_in_plan_(task.operators.size(), false) {
  for (const auto& x : task.goal)
    goal_.push_back(static_cast<std::uint32_t>(task.fact_index(x)));
  for (std::size_t i = 0; i < task.operators.size(); ++i) {
    const auto& op = task.operators[i];
    const auto cost =
      static_cast<int>(std::min<std::int64_t>(counted_cost(op, count), most_fact_cost));
    cost_of_.push_back(cost);
    for (const auto& effect : op.effects) {
      auto condition = op.precondition;
      condition.insert(condition.end(), effect.condition.begin(), effect.condition.end());
      add_unary(task, static_cast<int>(i), cost, std::move(condition), effect.fact);
    }
  }
  for (const auto& x : task.axioms)
    add_unary(task, -1, 0, x.body, {x.variable, 1});
  for (std::size_t i = 0; i < task.is_derived.size(); ++i)
    if (task.is_derived[i])
      always_true_.push_back(static_cast<std::uint32_t>(task.first_facts[i]));
  // Lists of users, one after the other.
  first_user_.assign(task.fact_count() + 1, 0);
  for (const auto x : preconditions_)
    ++first_user_[x + 1];
  for (std::size_t i = 1; i < first_user_.size(); ++i)
    first_user_[i] += first_user_[i - 1];
  users_.resize(preconditions_.size());
  auto next = first_user_;
  for (std::size_t i = 0; i < unary_.size(); ++i)
    for (std::uint32_t k = 0; k < unary_[i].preconditions; ++k)
      users_[next[preconditions_[unary_[i].first_precondition + k]]++] =
        static_cast<std::uint32_t>(i);
  unsatisfied_.resize(unary_.size());
  unary_cost_.resize(unary_.size());
}

void RelaxedPlanHeuristic::add_unary(const Task& task, int operator_index, int cost,
                                     std::vector<Fact> condition, Fact effect) {
  std::ranges::sort(condition);
  condition.erase(std::unique(condition.begin(), condition.end()), condition.end());
  if (std::ranges::find(condition, effect) != condition.end())
    return;
  Unary result;
  result.operator_index = operator_index;
  result.base_cost = cost;
  result.effect = static_cast<std::uint32_t>(task.fact_index(effect));
  result.first_precondition = static_cast<std::uint32_t>(preconditions_.size());
  result.preconditions = static_cast<std::uint32_t>(condition.size());
  if (condition.empty())
    without_preconditions_.push_back(static_cast<std::uint32_t>(unary_.size()));
  for (const auto& x : condition)
    preconditions_.push_back(static_cast<std::uint32_t>(task.fact_index(x)));
  unary_.push_back(result);
}

void RelaxedPlanHeuristic::enqueue(std::uint32_t fact, int cost, int reached_by) {
  auto& info = facts_[fact];
  if (info.cost >= 0 && info.cost <= cost)
    return;
  info.cost = std::min(cost, most_fact_cost);
  info.reached_by = reached_by;
  const auto bucket = static_cast<std::size_t>(info.cost);
  if (bucket < bucket_count) {
    buckets_[bucket].push_back(fact);
    ++bucketed_;
  } else {
    heap_.emplace_back(info.cost, fact);
    std::ranges::push_heap(heap_, std::greater{});
  }
}

void RelaxedPlanHeuristic::reach(std::uint32_t fact, int cost) {
  if (facts_[fact].cost != cost)
    return; // It was reached more cheaply.
  for (auto k = first_user_[fact]; k < first_user_[fact + 1]; ++k) {
    const auto user = users_[k];
    unary_cost_[user] = std::min(unary_cost_[user] + cost, most_fact_cost);
    if (--unsatisfied_[user] == 0)
      enqueue(unary_[user].effect, unary_cost_[user], static_cast<int>(user));
  }
}

void RelaxedPlanHeuristic::propagate() {
  for (std::size_t bucket = 0; bucketed_ > 0; ++bucket) {
    // The bucket may grow meanwhile.
    for (std::size_t i = 0; i < buckets_[bucket].size(); ++i, --bucketed_)
      reach(buckets_[bucket][i], static_cast<int>(bucket));
    buckets_[bucket].clear();
  }
  while (!heap_.empty()) {
    std::ranges::pop_heap(heap_, std::greater{});
    const auto [cost, fact] = heap_.back();
    heap_.pop_back();
    reach(fact, cost);
  }
}

void RelaxedPlanHeuristic::mark_plan(std::uint32_t goal) {
  pending_.push_back(goal);
  while (!pending_.empty()) {
    auto& info = facts_[pending_.back()];
    pending_.pop_back();
    if (info.is_marked)
      continue;
    info.is_marked = true;
    if (info.reached_by < 0)
      continue;
    const auto& unary = unary_[static_cast<std::size_t>(info.reached_by)];
    for (std::uint32_t i = 0; i < unary.preconditions; ++i)
      pending_.push_back(preconditions_[unary.first_precondition + i]);
    const int op = unary.operator_index;
    if (op >= 0 && !is_in_plan_[static_cast<std::size_t>(op)]) {
      is_in_plan_[static_cast<std::size_t>(op)] = true;
      plan_.push_back(op);
    }
  }
}

int RelaxedPlanHeuristic::evaluate(const State& state, std::vector<int>& preferred) {
  for (auto& x : facts_)
    x = {};
  for (std::size_t i = 0; i < unary_.size(); ++i) {
    unsatisfied_[i] = unary_[i].preconditions;
    unary_cost_[i] = unary_[i].base_cost;
  }
  for (std::size_t i = 0; i < state.size(); ++i)
    enqueue(static_cast<std::uint32_t>(task_.first_facts[i]) + static_cast<std::uint32_t>(state[i]),
            0, -1);
  for (const auto x : always_true_)
    enqueue(x, 0, -1);
  for (const auto x : without_preconditions_)
    enqueue(unary_[x].effect, unary_cost_[x], static_cast<int>(x));
  propagate();
  for (const auto x : goal_)
    if (facts_[x].cost < 0)
      return dead_end;
  for (const auto x : goal_)
    mark_plan(x);
  std::int64_t result = 0;
  for (const int x : plan_) {
    is_in_plan_[static_cast<std::size_t>(x)] = false;
    const auto& op = task_.operators[static_cast<std::size_t>(x)];
    if (holds(op.precondition, state))
      preferred.push_back(x);
  }
  for (const int x : plan_)
    result += cost_of_[static_cast<std::size_t>(x)];
  plan_.clear();
  return static_cast<int>(std::min<std::int64_t>(result, dead_end - 1));
}

} // namespace castor::planning
