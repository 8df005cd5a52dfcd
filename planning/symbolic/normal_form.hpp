#pragma once

#include "castor/planning/symbolic/lifted_task.hpp"

#include <cstddef>
#include <string>
#include <vector>

/// A task whose conditions are conjunctions of literals: disjunctions become several actions, or
/// derived predicates where that were too many; existentially quantified variables become further
/// parameters; "for all" becomes a conjunction over objects, or the negation of a derived predicate
/// (Helmert 2009, section 4).
namespace castor::planning {

/// Literals that hold together, for some values of the slots that they use.
struct NormalCondition {
  std::vector<Literal> literals;
  /// Slots of variables other than the parameters of the action or of the axiom.
  std::vector<int> slots;
};

struct NormalEffect {
  /// Its slots are those of "for all", too.
  NormalCondition condition;
  Literal literal;
};

struct NormalAction {
  /// Index in `LiftedTask::actions`.
  std::size_t action = 0;
  NormalCondition precondition;
  std::vector<NormalEffect> effects;
};

struct NormalAxiom {
  int predicate = 0;
  /// Types of all slots; the predicate's parameters come first.
  std::vector<Variable> variables;
  NormalCondition body;
};

struct NormalTask {
  /// With the predicates that were added.
  std::vector<Predicate> predicates;
  std::vector<NormalAction> actions;
  std::vector<NormalAxiom> axioms;
  /// Without variables.
  std::vector<Literal> goal;
};

NormalTask normalise(const LiftedTask& task);

} // namespace castor::planning
