#pragma once

#include "castor/planning/symbolic/lifted_task.hpp"
#include "castor/planning/symbolic/limits.hpp"
#include "castor/planning/symbolic/normal_form.hpp"

#include <cstdint>
#include <string>
#include <vector>

/// A task without variables: only what can be reached if nothing is ever deleted.
namespace castor::planning {

/// Atoms that are true and atoms that are false; indices.
struct GroundCondition {
  std::vector<int> positive;
  std::vector<int> negative;
};

struct GroundEffect {
  GroundCondition condition;
  int atom = 0;
  bool is_added = true;
};

struct GroundAction {
  /// "stack a b".
  std::string name;
  std::int64_t cost = 1;
  GroundCondition precondition;
  std::vector<GroundEffect> effects;
};

struct GroundAxiom {
  int atom = 0;
  GroundCondition body;
};

struct GroundTask {
  /// Reached ones that can change or are derived.
  std::vector<AtomKey> atoms;
  std::vector<bool> is_derived;
  std::vector<GroundAction> actions;
  /// In ascending order of strata.
  std::vector<GroundAxiom> axioms;
  /// Stratum of an axiom: those of a lower one are evaluated before.
  std::vector<int> strata;
  std::vector<int> initial;
  GroundCondition goal;
  /// The goal cannot be reached even if nothing is ever deleted.
  bool is_unreachable = false;
};

/// \throws LimitError
GroundTask ground(const LiftedTask& lifted, const NormalTask& task, LimitWatch& watch);

/// "(on a b)".
std::string atom_text(const LiftedTask& lifted, const NormalTask& task, const AtomKey& atom);

} // namespace castor::planning
