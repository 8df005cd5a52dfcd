#include "castor/planning/symbolic/reachability.hpp"

#include <algorithm>
#include <utility>

namespace castor::planning {

AtomTable::AtomTable(std::size_t predicates, std::size_t objects)
  : objects_(objects), of_predicate_(predicates) {
  // nop
}

namespace {

std::uint64_t argument_key(int predicate, std::size_t position, int object, std::size_t objects) {
  return (static_cast<std::uint64_t>(predicate) * 64 + position) * (objects + 1) +
         static_cast<std::uint64_t>(object);
}

} // namespace

void AtomTable::list(int atom) {
  const auto key = (*this)[atom];
  of_predicate_[static_cast<std::size_t>(key.front())].push_back(atom);
  for (std::size_t i = 1; i < key.size(); ++i)
    of_argument_[argument_key(key.front(), i - 1, key[i], objects_)].push_back(atom);
}

const std::vector<int>& AtomTable::with_predicate(int predicate) const {
  return of_predicate_[static_cast<std::size_t>(predicate)];
}

const std::vector<int>& AtomTable::with_argument(int predicate, std::size_t position,
                                                 int object) const {
  static const std::vector<int> none;
  const auto found = of_argument_.find(argument_key(predicate, position, object, objects_));
  return found == of_argument_.end() ? none : found->second;
}

Reachability::Reachability(const LiftedTask& task, std::vector<bool> can_change,
                           std::vector<ReachabilityRule> rules, LimitWatch& watch)
  : task_(task), can_change_(std::move(can_change)), rules_(std::move(rules)), watch_(watch),
    is_member_(task.types.size(), std::vector<bool>(task.objects.size(), false)),
    atoms_(can_change_.size(), task.objects.size()), triggers_(can_change_.size()) {
  for (std::size_t i = 0; i < task.types.size(); ++i)
    for (const int x : task.types[i].objects)
      is_member_[i][static_cast<std::size_t>(x)] = true;
  for (std::size_t i = 0; i < rules_.size(); ++i)
    for (std::size_t k = 0; k < rules_[i].body.size(); ++k)
      triggers_[static_cast<std::size_t>(rules_[i].body[k].predicate)].emplace_back(i, k);
}

void Reachability::run(const std::vector<AtomKey>& initial) {
  for (const auto& x : initial) {
    const auto before = atoms_.size();
    const int atom = atoms_.add(x);
    if (atoms_.size() > before && !can_change_[static_cast<std::size_t>(x.front())])
      atoms_.list(atom);
  }
  for (std::size_t i = 0; i < rules_.size(); ++i) {
    const auto is_static = [&](const Literal& x) {
      return !can_change_[static_cast<std::size_t>(x.predicate)];
    };
    if (!std::ranges::all_of(rules_[i].body, is_static))
      continue;
    values_.assign(rules_[i].types.size(), -1);
    is_joined_.assign(rules_[i].body.size(), false);
    join(i);
  }
  for (int atom = 0; static_cast<std::size_t>(atom) < atoms_.size(); ++atom)
    if (can_change_[static_cast<std::size_t>(atoms_[atom].front())]) {
      atoms_.list(atom);
      trigger(atom);
    }
}

void Reachability::trigger(int atom) {
  // The table may grow meanwhile.
  const auto listed = atoms_[atom];
  const AtomKey key(listed.begin(), listed.end());
  for (const auto& [rule, position] : triggers_[static_cast<std::size_t>(key.front())]) {
    watch_.check();
    values_.assign(rules_[rule].types.size(), -1);
    is_joined_.assign(rules_[rule].body.size(), false);
    std::vector<int> bound;
    if (!bind(rules_[rule], rules_[rule].body[position], key, bound))
      continue;
    is_joined_[position] = true;
    join(rule);
  }
}

bool Reachability::bind(const ReachabilityRule& rule, const Literal& literal,
                        std::span<const int> atom, std::vector<int>& bound) {
  for (std::size_t i = 0; i < literal.arguments.size(); ++i) {
    const Term term = literal.arguments[i];
    const int object = atom[i + 1];
    const int value = value_of(term);
    if (value == object)
      continue;
    if (value >= 0)
      return false;
    const auto slot = static_cast<std::size_t>(term);
    if (!is_member_[static_cast<std::size_t>(rule.types[slot])][static_cast<std::size_t>(object)])
      return false;
    values_[slot] = object;
    bound.push_back(term);
  }
  return true;
}

const std::vector<int>& Reachability::candidates(const Literal& literal) const {
  const auto* result = &atoms_.with_predicate(literal.predicate);
  for (std::size_t i = 0; i < literal.arguments.size(); ++i) {
    const int value = value_of(literal.arguments[i]);
    if (value < 0)
      continue;
    const auto& list = atoms_.with_argument(literal.predicate, i, value);
    if (list.size() < result->size())
      result = &list;
  }
  return *result;
}

void Reachability::join(std::size_t rule_index) {
  watch_.check();
  const auto& rule = rules_[rule_index];
  const std::vector<int>* best = nullptr;
  std::size_t position = 0;
  for (std::size_t i = 0; i < rule.body.size(); ++i) {
    if (is_joined_[i])
      continue;
    const auto& list = candidates(rule.body[i]);
    if (!best || list.size() < best->size()) {
      best = &list;
      position = i;
    }
    if (list.empty())
      return;
  }
  if (!best) {
    bind_free(rule_index, 0);
    return;
  }
  is_joined_[position] = true;
  // Lists do not grow meanwhile: atoms are listed by `run` alone.
  std::vector<int> bound;
  for (const int atom : *best) {
    bound.clear();
    if (bind(rule, rule.body[position], atoms_[atom], bound))
      join(rule_index);
    for (const int x : bound)
      values_[static_cast<std::size_t>(x)] = -1;
  }
  is_joined_[position] = false;
}

void Reachability::bind_free(std::size_t rule_index, std::size_t next) {
  const auto& rule = rules_[rule_index];
  while (next < rule.slots.size() && values_[static_cast<std::size_t>(rule.slots[next])] >= 0)
    ++next;
  if (next == rule.slots.size()) {
    finish(rule_index);
    return;
  }
  const auto slot = static_cast<std::size_t>(rule.slots[next]);
  for (const int object : task_.types[static_cast<std::size_t>(rule.types[slot])].objects) {
    watch_.check();
    values_[slot] = object;
    bind_free(rule_index, next + 1);
  }
  values_[slot] = -1;
}

bool Reachability::holds(const Literal& constraint) const {
  if (constraint.predicate == equality)
    return (value_of(constraint.arguments[0]) == value_of(constraint.arguments[1])) !=
           constraint.is_negated;
  AtomKey atom{constraint.predicate};
  for (const Term x : constraint.arguments)
    atom.push_back(value_of(x));
  return (atoms_.find(atom) >= 0) != constraint.is_negated;
}

void Reachability::finish(std::size_t rule_index) {
  const auto& rule = rules_[rule_index];
  if (!std::ranges::all_of(rule.constraints, [&](const Literal& x) { return holds(x); }))
    return;
  std::vector<int> instance{static_cast<int>(rule_index)};
  instance.insert(instance.end(), values_.begin(), values_.end());
  if (!instances_.add(instance).second)
    return;
  if (instances_.size() > watch_.limits().groundings)
    throw LimitError(LimitReached::groundings);
  for (const auto& head : rule.heads) {
    AtomKey atom{head.predicate};
    for (const Term x : head.arguments)
      atom.push_back(value_of(x));
    atoms_.add(atom);
  }
  // What the grounded task will need later is a small multiple.
  constexpr std::size_t bytes_of_instance = 400;
  bytes_ += bytes_of_instance + values_.size() * sizeof(int) + rule.heads.size() * 100;
  watch_.check_memory(bytes_);
}

} // namespace castor::planning
