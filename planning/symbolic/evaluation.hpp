#pragma once

#include "castor/planning/symbolic/lifted_task.hpp"

#include <set>
#include <vector>

/// Evaluation of conditions in a state, without making a searched task of it.
namespace castor::planning {

using AtomSet = std::set<AtomKey>;

/// The atom of a literal other than an equality.
/// @param values objects of the slots
AtomKey ground_atom(const Literal& literal, const std::vector<int>& values);

/// Whether the condition holds in the state. Derived predicates are taken as they are in `state`.
/// @param variables those of the action or axiom that the condition belongs to
/// @param values objects of the first slots, as many as there are parameters
bool holds(const LiftedTask& task, const Formula& condition, const std::vector<Variable>& variables,
           std::vector<int> values, const AtomSet& state);

} // namespace castor::planning
