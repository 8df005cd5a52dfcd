#pragma once

#include "castor/planning/symbolic/task.hpp"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace castor::planning {

/// How a search counts what an operator costs: LAMA (Richter and Westphal 2010) adds one to costs
/// so that free operators are not taken for nothing.
enum class CostCount : std::uint8_t { one, plus_one, real };

std::int64_t counted_cost(const TaskOperator& op, CostCount count);

/// Whether all operators cost 1.
bool has_unit_costs(const Task& task);

inline constexpr int dead_end = std::numeric_limits<int>::max();

/// h_FF: the cost of a plan that ignores what operators delete (Hoffmann and Nebel 2001), with the
/// cheapest supporters by h_add (Keyder and Geffner 2008). Negated derived atoms count as true.
class RelaxedPlanHeuristic {
public:
  RelaxedPlanHeuristic(const Task& task, CostCount count);

  /// Estimate of a state, or `dead_end` if the goal cannot be reached from it.
  /// @param preferred gets the applicable operators of the relaxed plan
  int evaluate(const State& state, std::vector<int>& preferred);

  /// Facts from which the last state's goal facts are reached: h_add of a fact, -1 if unreached.
  int fact_cost(std::size_t fact) const { return facts_[fact].cost; }

private:
  struct FactInfo {
    int cost = -1;
    /// Unary operator that reaches it most cheaply, -1 for facts of the state.
    int reached_by = -1;
    bool is_marked = false;
  };

  /// An operator with one effect.
  struct Unary {
    int operator_index = -1; // -1: an axiom
    int base_cost = 0;
    std::uint32_t effect = 0;
    std::uint32_t first_precondition = 0;
    std::uint32_t preconditions = 0;
  };

  void add_unary(const Task& task, int operator_index, int cost, std::vector<Fact> condition,
                 Fact effect);
  void enqueue(std::uint32_t fact, int cost, int reached_by);
  void reach(std::uint32_t fact, int cost);
  void propagate();
  void mark_plan(std::uint32_t fact);

  const Task& task_;
  std::vector<int> cost_of_;
  std::vector<std::uint32_t> goal_;
  std::vector<FactInfo> facts_;
  std::vector<Unary> unary_;
  std::vector<std::uint32_t> preconditions_;
  /// Unary operators that need a fact.
  std::vector<std::uint32_t> first_user_;
  std::vector<std::uint32_t> users_;
  std::vector<std::uint32_t> without_preconditions_;
  std::vector<std::uint32_t> always_true_;
  // Of one evaluation.
  std::vector<std::uint32_t> unsatisfied_;
  std::vector<int> unary_cost_;
  std::vector<std::vector<std::uint32_t>> buckets_;
  std::size_t bucketed_ = 0;
  std::vector<std::pair<int, std::uint32_t>> heap_;
  std::vector<int> plan_;
  std::vector<bool> is_in_plan_;
  std::vector<std::uint32_t> pending_;
};

} // namespace castor::planning
