#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

/// A planning task as PDDL describes it: actions with parameters.
namespace castor::planning {

/// A variable's slot in its action, if it is not negative; else the object `~term`.
using Term = int;

constexpr Term term_of_object(int object) {
  return ~object;
}
constexpr bool is_variable(Term term) {
  return term >= 0;
}

struct Type {
  std::string name;
  /// Indices of types; empty for the type object.
  std::vector<int> parents;
  /// Objects of this type and of its subtypes, in ascending order, once all are read.
  std::vector<int> objects;
};

struct Variable {
  std::string name;
  int type = 0;
};

struct PlanningObject {
  std::string name;
  int type = 0;
};

struct Predicate {
  std::string name;
  std::vector<Variable> parameters;
  /// Defined by axioms: not changed by actions.
  bool is_derived = false;
};

/// The predicate "=" of two terms.
inline constexpr int equality = -1;

struct Literal {
  int predicate = equality;
  std::vector<Term> arguments;
  bool is_negated = false;
};

/// In negation normal form: only literals are negated.
struct Formula {
  enum class Kind : std::uint8_t { literal, conjunction, disjunction, forall, exists };

  /// An empty conjunction is true, an empty disjunction false.
  Kind kind = Kind::conjunction;
  Literal literal;
  std::vector<Formula> parts;
  /// Slots of the quantified variables.
  std::vector<int> variables;
};

/// What an action does to one atom, for all values of `variables` with which the condition holds.
struct LiftedEffect {
  std::vector<int> variables;
  Formula condition;
  Literal literal;
};

/// A summand of an action's cost: the value of a function, or a number if there is none.
struct CostTerm {
  std::int64_t number = 0;
  int function = -1;
  std::vector<Term> arguments;
};

enum class ActionKind : std::uint8_t {
  action,
  /// Its agent then knows the value of a state variable.
  sensor,
  /// A promise, to be replaced by other actions as soon as its `replan` is known.
  assertion
};

struct ActionSchema {
  std::string name;
  ActionKind kind = ActionKind::action;
  /// The parameters, and then the quantified variables.
  std::vector<Variable> variables;
  std::size_t parameters = 0;
  Formula precondition;
  std::vector<LiftedEffect> effects;
  std::vector<CostTerm> costs;
  /// Of an assertion. It can be planned only if this does not hold in the beginning.
  Formula replan;
  /// What is so once a sensor was used in vain.
  Formula negative_outcome;
};

/// A derived atom is true if the body of one of its axioms holds.
struct AxiomSchema {
  int predicate = 0;
  /// Those of the predicate, and then the quantified variables.
  std::vector<Variable> variables;
  Formula body;
};

/// An atom without variables: the predicate's index, then the objects'.
using AtomKey = std::vector<int>;

struct LiftedTask {
  std::string domain;
  std::string problem;
  std::vector<Type> types;
  std::vector<PlanningObject> objects;
  std::vector<Predicate> predicates;
  std::vector<Predicate> functions;
  std::vector<ActionSchema> actions;
  std::vector<AxiomSchema> axioms;
  /// True in the beginning.
  std::vector<AtomKey> initial;
  /// Function's index and objects, to the value.
  std::map<AtomKey, std::int64_t> function_values;
  Formula goal;
  std::vector<Variable> goal_variables;
  /// Whether actions cost what they say; if not, each costs 1.
  bool has_costs = false;
};

} // namespace castor::planning
