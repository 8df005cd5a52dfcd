#pragma once

#include "castor/planning/symbolic/ground_task.hpp"

#include <compare>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

/// A task of variables with finite domains, SAS+ with conditional effects and axioms (Helmert
/// 2009): what is searched.
namespace castor::planning {

struct Fact {
  int variable = 0;
  int value = 0;

  friend auto operator<=>(const Fact&, const Fact&) = default;
};

struct TaskEffect {
  std::vector<Fact> condition;
  Fact fact;
};

struct TaskOperator {
  std::string name;
  std::int64_t cost = 1;
  /// In ascending order.
  std::vector<Fact> precondition;
  /// Those that come later win. All conditions are of the state before.
  std::vector<TaskEffect> effects;
};

struct TaskAxiom {
  std::vector<Fact> body;
  /// Gets the value 1; has 0 otherwise.
  int variable = 0;
  int stratum = 0;
};

/// Values of all variables.
using State = std::vector<int>;

struct Task {
  std::vector<int> domain_sizes;
  /// Names of the values of each variable.
  std::vector<std::vector<std::string>> value_names;
  std::vector<bool> is_derived;
  std::vector<TaskOperator> operators;
  /// In ascending order of strata.
  std::vector<TaskAxiom> axioms;
  /// With derived variables evaluated.
  State initial;
  std::vector<Fact> goal;
  bool is_unreachable = false;

  /// Number of a fact among those of all variables.
  std::size_t fact_index(const Fact& x) const {
    return first_facts[static_cast<std::size_t>(x.variable)] + static_cast<std::size_t>(x.value);
  }
  std::size_t fact_count() const { return first_facts.empty() ? 0 : first_facts.back(); }

  /// First fact of each variable, and the number of all facts.
  std::vector<std::size_t> first_facts;
  /// Predicate of each fact, -1 for "none of these".
  std::vector<int> fact_predicates;
  /// Numbers of the groups that a fact is in, of which at most one fact is true at a time.
  std::vector<std::vector<int>> mutex_groups_of;
};

/// Groups of atoms of which at most one is true, as indices of `GroundTask::atoms`. They may
/// overlap: then an atom belongs to the variable of the largest.
using MutexGroups = std::vector<std::vector<int>>;

/// @param groups may be empty: then each atom is a variable of its own
/// \throws LimitError
Task make_task(const LiftedTask& lifted, const NormalTask& normal, const GroundTask& ground,
               const MutexGroups& groups, LimitWatch& watch);

bool holds(const std::vector<Fact>& condition, const State& state);

/// Sets the derived variables.
void evaluate_axioms(const Task& task, State& state);

/// The state after the operator, which is applicable in `before`.
void apply(const Task& task, const TaskOperator& op, const State& before, State& after);

} // namespace castor::planning
