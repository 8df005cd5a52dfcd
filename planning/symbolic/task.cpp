#include "castor/planning/symbolic/task.hpp"

#include <algorithm>
#include <utility>

namespace castor::planning {

namespace {

class TaskMaker {
public:
  TaskMaker(const LiftedTask& lifted, const NormalTask& normal, const GroundTask& ground,
            const MutexGroups& groups, LimitWatch& watch)
    : lifted_(lifted), normal_(normal), ground_(ground), watch_(watch),
      facts_(ground.atoms.size(), {-1, 0}) {
    result_.is_unreachable = ground.is_unreachable;
    cover(groups);
    for (std::size_t i = 0; i < ground.atoms.size(); ++i)
      if (facts_[i].variable < 0)
        add_variable({static_cast<int>(i)});
  }

  Task run() {
    result_.initial.resize(result_.domain_sizes.size());
    for (std::size_t i = 0; i < result_.initial.size(); ++i)
      result_.initial[i] = none_[i];
    for (const int x : ground_.initial)
      result_.initial[static_cast<std::size_t>(fact(x).variable)] = fact(x).value;
    result_.goal = condition(ground_.goal);
    result_.is_unreachable |= is_contradiction(result_.goal);
    for (const auto& x : ground_.actions) {
      watch_.check(1 + x.effects.size());
      add_operator(x);
    }
    for (std::size_t i = 0; i < ground_.axioms.size(); ++i)
      result_.axioms.push_back({condition(ground_.axioms[i].body),
                                fact(ground_.axioms[i].atom).variable, ground_.strata[i]});
    std::size_t count = 0;
    for (const int x : result_.domain_sizes) {
      result_.first_facts.push_back(count);
      count += static_cast<std::size_t>(x);
    }
    result_.first_facts.push_back(count);
    describe_facts();
    evaluate_axioms(result_, result_.initial);
    return std::move(result_);
  }

private:
  const Fact& fact(int atom) const { return facts_[static_cast<std::size_t>(atom)]; }

  /// Makes variables of groups, the largest first, that together have each atom once. Atoms that
  /// are needed false are left out: "none of these" is false for all.
  void cover(const MutexGroups& groups) {
    std::vector<bool> is_needed_false(facts_.size(), false);
    const auto mark = [&](const GroundCondition& x) {
      for (const int atom : x.negative)
        is_needed_false[static_cast<std::size_t>(atom)] = true;
    };
    mark(ground_.goal);
    for (const auto& action : ground_.actions) {
      watch_.check();
      mark(action.precondition);
      for (const auto& x : action.effects)
        mark(x.condition);
    }
    for (const auto& x : ground_.axioms)
      mark(x.body);
    groups_ = groups;
    auto left = groups;
    for (auto& x : left)
      std::erase_if(x, [&](int atom) { return is_needed_false[static_cast<std::size_t>(atom)]; });
    while (true) {
      watch_.check(1 + left.size() / 64);
      const auto largest = std::ranges::max_element(left, {}, &std::vector<int>::size);
      if (largest == left.end() || largest->size() < 2)
        return;
      const auto group = std::move(*largest);
      left.erase(largest);
      add_variable(group);
      for (auto& x : left)
        std::erase_if(x, [&](int atom) { return fact(atom).variable >= 0; });
    }
  }

  void describe_facts() {
    result_.fact_predicates.assign(result_.fact_count(), -1);
    result_.mutex_groups_of.resize(result_.fact_count());
    for (std::size_t i = 0; i < facts_.size(); ++i)
      result_.fact_predicates[result_.fact_index(facts_[i])] = ground_.atoms[i].front();
    int group = 0;
    for (const auto& x : groups_) {
      for (const int atom : x)
        result_.mutex_groups_of[result_.fact_index(fact(atom))].push_back(group);
      ++group;
    }
    for (std::size_t i = 0; i < result_.domain_sizes.size(); ++i, ++group)
      for (int value = 0; value < result_.domain_sizes[i]; ++value)
        result_.mutex_groups_of[result_.fact_index({static_cast<int>(i), value})].push_back(group);
  }

  /// Value 0 is that no atom is true.
  void add_variable(const std::vector<int>& atoms) {
    const int variable = static_cast<int>(result_.domain_sizes.size());
    std::vector<std::string> names{"none"};
    for (const int x : atoms) {
      const auto& key = ground_.atoms[static_cast<std::size_t>(x)];
      facts_[static_cast<std::size_t>(x)] = {variable, static_cast<int>(names.size())};
      names.push_back(atom_text(lifted_, normal_, key));
    }
    if (names.size() == 2)
      names[0] = "not " + names[1];
    none_.push_back(0);
    result_.is_derived.push_back(ground_.is_derived[static_cast<std::size_t>(atoms.front())]);
    result_.domain_sizes.push_back(static_cast<int>(names.size()));
    result_.value_names.push_back(std::move(names));
  }

  std::vector<Fact> condition(const GroundCondition& x) const {
    std::vector<Fact> result;
    for (const int atom : x.positive)
      result.push_back(fact(atom));
    for (const int atom : x.negative)
      result.push_back({fact(atom).variable, 0});
    std::ranges::sort(result);
    return result;
  }

  /// Whether two facts are of the same variable: then they cannot be true together.
  static bool is_contradiction(const std::vector<Fact>& facts) {
    return std::ranges::adjacent_find(facts, {}, &Fact::variable) != facts.end();
  }

  void add_operator(const GroundAction& action) {
    TaskOperator result;
    result.name = action.name;
    result.cost = action.cost;
    result.precondition = condition(action.precondition);
    if (is_contradiction(result.precondition))
      return;
    // What is added wins over what is deleted.
    for (const bool is_added : {false, true})
      for (const auto& x : action.effects)
        if (x.is_added == is_added)
          add_effect(result, x);
    if (!result.effects.empty())
      result_.operators.push_back(std::move(result));
  }

  static void add_effect(TaskOperator& op, const GroundEffect& effect, std::vector<Fact> facts,
                         Fact atom) {
    const auto is_given = [&](const Fact& x) {
      return std::ranges::binary_search(op.precondition, x);
    };
    if (!effect.is_added) {
      // Only if it is true: another value of the variable stays.
      if (!is_given(atom))
        facts.push_back(atom);
      atom.value = 0;
    }
    std::erase_if(facts, is_given);
    std::ranges::sort(facts);
    facts.erase(std::unique(facts.begin(), facts.end()), facts.end());
    // A condition that contradicts itself or the precondition is never true.
    auto all = facts;
    all.insert(all.end(), op.precondition.begin(), op.precondition.end());
    std::ranges::sort(all);
    if (is_contradiction(all))
      return;
    if (facts.empty()) {
      if (is_given(atom) && std::ranges::none_of(op.effects, [&](const TaskEffect& x) {
            return x.fact.variable == atom.variable;
          }))
        return;
      std::erase_if(op.effects,
                    [&](const TaskEffect& x) { return x.fact.variable == atom.variable; });
      if (is_given(atom))
        return;
    }
    op.effects.push_back({std::move(facts), atom});
  }

  void add_effect(TaskOperator& op, const GroundEffect& effect) const {
    add_effect(op, effect, condition(effect.condition), fact(effect.atom));
  }

  const LiftedTask& lifted_;
  const NormalTask& normal_;
  const GroundTask& ground_;
  LimitWatch& watch_;
  MutexGroups groups_;
  std::vector<Fact> facts_;
  std::vector<int> none_;
  Task result_;
};

} // namespace

Task make_task(const LiftedTask& lifted, const NormalTask& normal, const GroundTask& ground,
               const MutexGroups& groups, LimitWatch& watch) {
  return TaskMaker(lifted, normal, ground, groups, watch).run();
}

bool holds(const std::vector<Fact>& condition, const State& state) {
  return std::ranges::all_of(condition, [&](const Fact& x) {
    return state[static_cast<std::size_t>(x.variable)] == x.value;
  });
}

void evaluate_axioms(const Task& task, State& state) {
  if (task.axioms.empty())
    return;
  for (std::size_t i = 0; i < state.size(); ++i)
    if (task.is_derived[i])
      state[i] = 0;
  for (std::size_t begin = 0; begin < task.axioms.size();) {
    auto end = begin;
    while (end < task.axioms.size() && task.axioms[end].stratum == task.axioms[begin].stratum)
      ++end;
    bool has_changed = true;
    while (has_changed) {
      has_changed = false;
      for (auto i = begin; i < end; ++i) {
        const auto& axiom = task.axioms[i];
        auto& value = state[static_cast<std::size_t>(axiom.variable)];
        if (value == 0 && holds(axiom.body, state)) {
          value = 1;
          has_changed = true;
        }
      }
    }
    begin = end;
  }
}

void apply(const Task& task, const TaskOperator& op, const State& before, State& after) {
  after = before;
  for (const auto& x : op.effects)
    if (holds(x.condition, before))
      after[static_cast<std::size_t>(x.fact.variable)] = x.fact.value;
  evaluate_axioms(task, after);
}

} // namespace castor::planning
