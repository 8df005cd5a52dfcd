#include "castor/planning/symbolic/ground_task.hpp"

#include "castor/planning/symbolic/reachability.hpp"

#include <algorithm>
#include <span>
#include <utility>

namespace castor::planning {

namespace {

std::size_t index_of(int x) {
  return static_cast<std::size_t>(x);
}

/// What the instances of a rule become.
struct RuleMeaning {
  enum class Kind : std::uint8_t { action, effect, axiom };
  Kind kind = Kind::action;
  /// Index of the normal action or axiom.
  std::size_t index = 0;
  /// Index of the action's effect.
  std::size_t effect = 0;
};

class Grounder {
public:
  Grounder(const LiftedTask& lifted, const NormalTask& task, LimitWatch& watch)
    : lifted_(lifted), task_(task), watch_(watch), can_change_(task.predicates.size(), false) {
    for (std::size_t i = 0; i < task.predicates.size(); ++i)
      can_change_[i] = task.predicates[i].is_derived;
    for (const auto& action : task.actions)
      for (const auto& effect : action.effects)
        can_change_[index_of(effect.literal.predicate)] = true;
  }

  GroundTask run() {
    add_rules();
    reachability_.emplace_back(lifted_, can_change_, rules_, watch_);
    reachability_.front().run(lifted_.initial);
    find_constants();
    number_atoms();
    make_actions();
    make_effects();
    make_axioms();
    make_goal();
    return std::move(result_);
  }

private:
  bool is_static(const Literal& x) const {
    return x.predicate == equality || !can_change_[index_of(x.predicate)];
  }

  void add_condition(ReachabilityRule& rule, const std::vector<Literal>& literals) const {
    for (const auto& x : literals)
      if (x.predicate == equality || (x.is_negated && is_static(x)))
        rule.constraints.push_back(x);
      else if (!x.is_negated)
        rule.body.push_back(x);
  }

  static ReachabilityRule rule_of(const std::vector<Variable>& variables, std::size_t parameters,
                                  const std::vector<int>& slots) {
    ReachabilityRule result;
    for (const auto& x : variables)
      result.types.push_back(x.type);
    for (std::size_t i = 0; i < parameters; ++i)
      result.slots.push_back(static_cast<int>(i));
    result.slots.insert(result.slots.end(), slots.begin(), slots.end());
    return result;
  }

  void add_rules() {
    for (std::size_t i = 0; i < task_.actions.size(); ++i) {
      const auto& action = task_.actions[i];
      const auto& schema = lifted_.actions[action.action];
      auto main = rule_of(schema.variables, schema.parameters, action.precondition.slots);
      add_condition(main, action.precondition.literals);
      const auto base = main;
      for (const auto& x : action.effects)
        if (is_simple(x) && !x.literal.is_negated)
          main.heads.push_back(x.literal);
      rules_.push_back(std::move(main));
      meanings_.push_back({RuleMeaning::Kind::action, i, 0});
      for (std::size_t k = 0; k < action.effects.size(); ++k) {
        const auto& effect = action.effects[k];
        if (is_simple(effect))
          continue;
        auto rule = base;
        rule.slots.insert(rule.slots.end(), effect.condition.slots.begin(),
                          effect.condition.slots.end());
        add_condition(rule, effect.condition.literals);
        if (!effect.literal.is_negated)
          rule.heads.push_back(effect.literal);
        rules_.push_back(std::move(rule));
        meanings_.push_back({RuleMeaning::Kind::effect, i, k});
      }
    }
    for (std::size_t i = 0; i < task_.axioms.size(); ++i) {
      const auto& axiom = task_.axioms[i];
      const auto parameters = task_.predicates[index_of(axiom.predicate)].parameters.size();
      auto rule = rule_of(axiom.variables, parameters, axiom.body.slots);
      add_condition(rule, axiom.body.literals);
      Literal head;
      head.predicate = axiom.predicate;
      for (std::size_t k = 0; k < parameters; ++k)
        head.arguments.push_back(static_cast<Term>(k));
      rule.heads.push_back(std::move(head));
      rules_.push_back(std::move(rule));
      meanings_.push_back({RuleMeaning::Kind::axiom, i, 0});
    }
  }

  static bool is_simple(const NormalEffect& x) {
    return x.condition.literals.empty() && x.condition.slots.empty();
  }

  const AtomTable& atoms() const { return reachability_.front().atoms(); }

  /// Number of the literal's atom in the table, or -1 if it is never reached.
  int atom_of(const Literal& literal, std::span<const int> values) const {
    key_.assign(1, literal.predicate);
    for (const Term x : literal.arguments)
      key_.push_back(is_variable(x) ? values[index_of(x)] : ~x);
    return atoms().find(key_);
  }

  template <class F>
  void for_each_effect(F&& f) const {
    for (std::size_t number = 0; number < reachability_.front().instance_count(); ++number) {
      watch_.check();
      const auto instance = reachability_.front().instance(number);
      const auto& meaning = meanings_[instance.rule];
      if (meaning.kind == RuleMeaning::Kind::axiom)
        continue;
      const auto& effects = task_.actions[meaning.index].effects;
      if (meaning.kind == RuleMeaning::Kind::effect)
        f(instance, effects[meaning.effect]);
      else
        for (const auto& x : effects)
          if (is_simple(x))
            f(instance, x);
    }
  }

  /// Atoms that are true in the beginning and are never deleted.
  void find_constants() {
    is_constant_.assign(atoms().size(), false);
    for (const auto& x : lifted_.initial)
      is_constant_[index_of(atoms().find(x))] = true;
    for_each_effect([&](const RuleInstance& instance, const NormalEffect& effect) {
      if (!effect.literal.is_negated)
        return;
      const int atom = atom_of(effect.literal, instance.values);
      if (atom >= 0)
        is_constant_[index_of(atom)] = false;
    });
  }

  void number_atoms() {
    numbers_.assign(atoms().size(), -1);
    for (int i = 0; index_of(i) < atoms().size(); ++i) {
      const auto predicate = index_of(atoms()[i].front());
      if (!can_change_[predicate] || is_constant_[index_of(i)])
        continue;
      numbers_[index_of(i)] = static_cast<int>(result_.atoms.size());
      const auto atom = atoms()[i];
      result_.atoms.emplace_back(atom.begin(), atom.end());
      result_.is_derived.push_back(task_.predicates[predicate].is_derived);
    }
    for (const auto& x : lifted_.initial) {
      const int number = numbers_[index_of(atoms().find(x))];
      if (number >= 0)
        result_.initial.push_back(number);
    }
    std::ranges::sort(result_.initial);
    result_.initial.erase(std::unique(result_.initial.begin(), result_.initial.end()),
                          result_.initial.end());
  }

  /// Adds the literals that can be true and can be false. False if they cannot all be true.
  bool add_literals(const std::vector<Literal>& literals, std::span<const int> values,
                    GroundCondition& condition) const {
    for (const auto& x : literals) {
      if (x.predicate == equality)
        continue;
      const int atom = atom_of(x, values);
      if (atom < 0) {
        if (!x.is_negated)
          return false;
        continue;
      }
      const int number = numbers_[index_of(atom)];
      if (number >= 0)
        (x.is_negated ? condition.negative : condition.positive).push_back(number);
      else if (x.is_negated)
        return false;
    }
    for (auto* list : {&condition.positive, &condition.negative}) {
      std::ranges::sort(*list);
      list->erase(std::unique(list->begin(), list->end()), list->end());
    }
    std::vector<int> both;
    std::ranges::set_intersection(condition.positive, condition.negative, std::back_inserter(both));
    return both.empty();
  }

  bool add_cost(const ActionSchema& schema, std::span<const int> values,
                GroundAction& action) const {
    if (!lifted_.has_costs)
      return true;
    action.cost = 0;
    for (const auto& x : schema.costs) {
      if (x.function < 0) {
        action.cost += x.number;
        continue;
      }
      AtomKey key{x.function};
      for (const Term term : x.arguments)
        key.push_back(is_variable(term) ? values[index_of(term)] : ~term);
      const auto found = lifted_.function_values.find(key);
      if (found == lifted_.function_values.end())
        return false;
      action.cost += found->second;
    }
    return true;
  }

  void make_actions() {
    for (std::size_t number = 0; number < reachability_.front().instance_count(); ++number) {
      const auto instance = reachability_.front().instance(number);
      watch_.check();
      const auto& meaning = meanings_[instance.rule];
      if (meaning.kind != RuleMeaning::Kind::action)
        continue;
      const auto& normal = task_.actions[meaning.index];
      const auto& schema = lifted_.actions[normal.action];
      GroundAction action;
      if (!add_literals(normal.precondition.literals, instance.values, action.precondition) ||
          !add_cost(schema, instance.values, action))
        continue;
      action.name = schema.name;
      for (std::size_t i = 0; i < schema.parameters; ++i)
        action.name += ' ' + lifted_.objects[index_of(instance.values[i])].name;
      for (const auto& effect : normal.effects)
        if (is_simple(effect))
          add_effect(action, effect, instance.values);
      std::vector<int> key(instance.values.begin(), instance.values.end());
      key.push_back(static_cast<int>(meaning.index));
      actions_.add(key);
      result_.actions.push_back(std::move(action));
    }
  }

  void add_effect(GroundAction& action, const NormalEffect& effect,
                  std::span<const int> values) const {
    const int atom = atom_of(effect.literal, values);
    GroundEffect result;
    if (atom < 0 || numbers_[index_of(atom)] < 0 ||
        !add_literals(effect.condition.literals, values, result.condition))
      return;
    result.atom = numbers_[index_of(atom)];
    result.is_added = !effect.literal.is_negated;
    action.effects.push_back(std::move(result));
  }

  void make_effects() {
    for (std::size_t number = 0; number < reachability_.front().instance_count(); ++number) {
      const auto instance = reachability_.front().instance(number);
      watch_.check();
      const auto& meaning = meanings_[instance.rule];
      if (meaning.kind != RuleMeaning::Kind::effect)
        continue;
      const auto& normal = task_.actions[meaning.index];
      const auto parameters = lifted_.actions[normal.action].parameters;
      std::vector<int> key(instance.values.size(), -1);
      std::copy_n(instance.values.begin(), parameters, key.begin());
      for (const int slot : normal.precondition.slots)
        key[index_of(slot)] = instance.values[index_of(slot)];
      key.push_back(static_cast<int>(meaning.index));
      const int found = actions_.find(key);
      if (found >= 0)
        add_effect(result_.actions[index_of(found)], normal.effects[meaning.effect],
                   instance.values);
    }
  }

  /// Stratum of each derived predicate: above all that it depends on by negation.
  std::vector<int> predicate_strata() const {
    std::vector<int> result(task_.predicates.size(), 0);
    bool has_changed = true;
    while (has_changed) {
      has_changed = false;
      for (const auto& axiom : task_.axioms)
        for (const auto& x : axiom.body.literals) {
          if (x.predicate == equality || !task_.predicates[index_of(x.predicate)].is_derived)
            continue;
          const int least = result[index_of(x.predicate)] + (x.is_negated ? 1 : 0);
          auto& stratum = result[index_of(axiom.predicate)];
          has_changed |= stratum < least;
          stratum = std::max(stratum, least);
        }
    }
    return result;
  }

  void make_axioms() {
    const auto strata = predicate_strata();
    std::vector<std::pair<int, GroundAxiom>> axioms;
    for (std::size_t number = 0; number < reachability_.front().instance_count(); ++number) {
      watch_.check();
      const auto instance = reachability_.front().instance(number);
      const auto& meaning = meanings_[instance.rule];
      if (meaning.kind != RuleMeaning::Kind::axiom)
        continue;
      const auto& normal = task_.axioms[meaning.index];
      GroundAxiom axiom;
      if (!add_literals(normal.body.literals, instance.values, axiom.body))
        continue;
      axiom.atom =
        numbers_[index_of(atom_of(rules_[instance.rule].heads.front(), instance.values))];
      axioms.emplace_back(strata[index_of(normal.predicate)], std::move(axiom));
    }
    std::ranges::stable_sort(axioms, {}, [](const auto& x) { return x.first; });
    for (auto& [stratum, axiom] : axioms) {
      result_.strata.push_back(stratum);
      result_.axioms.push_back(std::move(axiom));
    }
  }

  void make_goal() {
    for (const auto& x : task_.goal)
      if (x.predicate == equality && ((x.arguments[0] == x.arguments[1]) == x.is_negated))
        result_.is_unreachable = true;
    if (!add_literals(task_.goal, {}, result_.goal))
      result_.is_unreachable = true;
  }

  const LiftedTask& lifted_;
  const NormalTask& task_;
  LimitWatch& watch_;
  std::vector<bool> can_change_;
  std::vector<ReachabilityRule> rules_;
  std::vector<RuleMeaning> meanings_;
  /// One, once the rules are known.
  std::vector<Reachability> reachability_;
  std::vector<bool> is_constant_;
  /// In the result, by numbers of the table; -1 for atoms that do not change.
  std::vector<int> numbers_;
  /// Values of the slots and index of the normal action of each ground action.
  TupleTable actions_;
  mutable AtomKey key_;
  GroundTask result_;
};

} // namespace

GroundTask ground(const LiftedTask& lifted, const NormalTask& task, LimitWatch& watch) {
  return Grounder(lifted, task, watch).run();
}

std::string atom_text(const LiftedTask& lifted, const NormalTask& task, const AtomKey& atom) {
  std::string result = "(" + task.predicates[index_of(atom.front())].name;
  for (std::size_t i = 1; i < atom.size(); ++i)
    result += ' ' + lifted.objects[index_of(atom[i])].name;
  return result + ")";
}

} // namespace castor::planning
