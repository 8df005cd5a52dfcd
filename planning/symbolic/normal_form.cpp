#include "castor/planning/symbolic/normal_form.hpp"

#include <algorithm>
#include <iterator>
#include <map>
#include <set>
#include <utility>

namespace castor::planning {

namespace {

using Kind = Formula::Kind;

/// Disjuncts of one condition, beyond which they become a derived predicate.
constexpr std::size_t most_disjuncts = 16;
/// Instances of one "for all", beyond which it becomes a derived predicate.
constexpr std::size_t most_instances = 20000;

Formula negated(const Formula& formula) {
  Formula result = formula;
  switch (formula.kind) {
    case Kind::literal:
      result.literal.is_negated = !formula.literal.is_negated;
      return result;
    case Kind::conjunction:
      result.kind = Kind::disjunction;
      break;
    case Kind::disjunction:
      result.kind = Kind::conjunction;
      break;
    case Kind::forall:
      result.kind = Kind::exists;
      break;
    case Kind::exists:
      result.kind = Kind::forall;
      break;
  }
  for (auto& x : result.parts)
    x = negated(x);
  return result;
}

using Substitution = std::map<int, Term>;

Term substituted(Term term, const Substitution& terms) {
  const auto found = is_variable(term) ? terms.find(term) : terms.end();
  return found == terms.end() ? term : found->second;
}

/// @param terms for variables; quantified ones may be renamed, too
void substitute(Formula& formula, const Substitution& terms) {
  for (auto& x : formula.literal.arguments)
    x = substituted(x, terms);
  for (auto& x : formula.variables)
    x = substituted(x, terms);
  for (auto& x : formula.parts)
    substitute(x, terms);
}

/// Slots that the formula uses, and among them those that it quantifies.
void collect_slots(const Formula& formula, std::set<int>& used, std::set<int>& quantified) {
  for (const Term x : formula.literal.arguments)
    if (is_variable(x))
      used.insert(x);
  for (const int x : formula.variables) {
    used.insert(x);
    quantified.insert(x);
  }
  for (const auto& x : formula.parts)
    collect_slots(x, used, quantified);
}

/// Whether all instances of the formula together are a conjunction of literals.
bool is_conjunctive(const Formula& formula) {
  if (formula.kind == Kind::literal)
    return true;
  if (formula.kind == Kind::exists ||
      (formula.kind == Kind::disjunction && formula.parts.size() != 1))
    return false;
  return std::ranges::all_of(formula.parts, is_conjunctive);
}

class Normaliser {
public:
  explicit Normaliser(const LiftedTask& task) : task_(task) {
    result_.predicates = task.predicates;
  }

  NormalTask run() {
    for (std::size_t i = 0; i < task_.actions.size(); ++i)
      add_action(i);
    for (const auto& x : task_.axioms)
      add_axiom(x);
    add_goal();
    // Axioms may add axioms.
    for (std::size_t i = 0; i < added_.size(); ++i)
      add_axiom(AxiomSchema(added_[i]));
    return std::move(result_);
  }

private:
  std::size_t instances_of(const Formula& forall, const std::vector<Variable>& variables) const {
    std::size_t result = 1;
    for (const int x : forall.variables) {
      const auto type = static_cast<std::size_t>(variables[static_cast<std::size_t>(x)].type);
      result = std::min(result * task_.types[type].objects.size(), most_instances + 1);
    }
    return result;
  }

  /// The formula as an atom of a predicate that is derived from it.
  Literal derived_atom(const Formula& formula, const std::vector<Variable>& variables) {
    std::set<int> used;
    std::set<int> quantified;
    collect_slots(formula, used, quantified);
    AxiomSchema axiom;
    Literal atom;
    Predicate predicate;
    Substitution renamed;
    const auto add_slot = [&](int slot) {
      renamed[slot] = static_cast<Term>(axiom.variables.size());
      axiom.variables.push_back(variables[static_cast<std::size_t>(slot)]);
    };
    for (const int x : used)
      if (!quantified.contains(x)) {
        atom.arguments.push_back(x);
        add_slot(x);
      }
    predicate.parameters = axiom.variables;
    for (const int x : quantified)
      add_slot(x);
    axiom.body = formula;
    substitute(axiom.body, renamed);
    axiom.predicate = atom.predicate = static_cast<int>(result_.predicates.size());
    predicate.name = "condition-" + std::to_string(result_.predicates.size());
    predicate.is_derived = true;
    result_.predicates.push_back(std::move(predicate));
    added_.push_back(std::move(axiom));
    return atom;
  }

  std::vector<NormalCondition> split(const Formula& formula,
                                     const std::vector<Variable>& variables) {
    std::vector<NormalCondition> result;
    switch (formula.kind) {
      case Kind::literal:
        result.push_back({{formula.literal}, {}});
        break;
      case Kind::disjunction:
        for (const auto& part : formula.parts)
          std::ranges::move(split(part, variables), std::back_inserter(result));
        break;
      case Kind::conjunction:
        return split_conjunction(formula, variables);
      case Kind::exists:
        result = split(formula.parts.front(), variables);
        for (auto& x : result)
          x.slots.insert(x.slots.end(), formula.variables.begin(), formula.variables.end());
        break;
      case Kind::forall:
        if (is_conjunctive(formula.parts.front()) &&
            instances_of(formula, variables) <= most_instances)
          return split(expanded(formula, variables), variables);
        result.push_back({{derived_atom(negated(formula), variables)}, {}});
        result.back().literals.front().is_negated = true;
        break;
    }
    return result;
  }

  std::vector<NormalCondition> split_conjunction(const Formula& formula,
                                                 const std::vector<Variable>& variables) {
    std::vector<std::vector<NormalCondition>> parts;
    std::size_t count = 1;
    for (const auto& part : formula.parts) {
      parts.push_back(split(part, variables));
      count = std::min(count * parts.back().size(), most_disjuncts + 1);
    }
    if (count > most_disjuncts)
      for (std::size_t i = 0; i < parts.size(); ++i)
        if (parts[i].size() > 1)
          parts[i] = {{{derived_atom(formula.parts[i], variables)}, {}}};
    std::vector<NormalCondition> result(1);
    for (const auto& part : parts) {
      std::vector<NormalCondition> product;
      for (const auto& a : result)
        for (const auto& b : part) {
          auto both = a;
          both.literals.insert(both.literals.end(), b.literals.begin(), b.literals.end());
          both.slots.insert(both.slots.end(), b.slots.begin(), b.slots.end());
          product.push_back(std::move(both));
        }
      result = std::move(product);
    }
    return result;
  }

  /// The conjunction over all values of the quantified variables.
  Formula expanded(const Formula& forall, const std::vector<Variable>& variables) const {
    std::vector<Formula> instances{forall.parts.front()};
    for (const int slot : forall.variables) {
      const auto type = static_cast<std::size_t>(variables[static_cast<std::size_t>(slot)].type);
      std::vector<Formula> next;
      for (const auto& instance : instances)
        for (const int object : task_.types[type].objects) {
          next.push_back(instance);
          substitute(next.back(), {{slot, term_of_object(object)}});
        }
      instances = std::move(next);
    }
    Formula result;
    result.parts = std::move(instances);
    return result;
  }

  void add_action(std::size_t index) {
    const auto& schema = task_.actions[index];
    std::vector<NormalEffect> effects;
    for (const auto& x : schema.effects)
      for (auto& condition : split(x.condition, schema.variables)) {
        condition.slots.insert(condition.slots.end(), x.variables.begin(), x.variables.end());
        effects.push_back({std::move(condition), x.literal});
      }
    for (auto& precondition : split(schema.precondition, schema.variables))
      result_.actions.push_back({index, std::move(precondition), effects});
  }

  void add_axiom(const AxiomSchema& axiom) {
    for (auto& body : split(axiom.body, axiom.variables))
      result_.axioms.push_back({axiom.predicate, axiom.variables, std::move(body)});
  }

  void add_goal() {
    auto parts = split(task_.goal, task_.goal_variables);
    if (parts.size() == 1 && parts.front().slots.empty())
      result_.goal = std::move(parts.front().literals);
    else
      result_.goal = {derived_atom(task_.goal, task_.goal_variables)};
  }

  const LiftedTask& task_;
  NormalTask result_;
  std::vector<AxiomSchema> added_;
};

} // namespace

NormalTask normalise(const LiftedTask& task) {
  return Normaliser(task).run();
}

} // namespace castor::planning
