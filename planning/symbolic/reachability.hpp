#pragma once

#include "castor/planning/symbolic/lifted_task.hpp"
#include "castor/planning/symbolic/limits.hpp"

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace castor::planning {

/// Numbers for atoms without variables, and lists of those with a certain argument.
class AtomTable {
public:
  AtomTable(std::size_t predicates, std::size_t objects);

  /// Number of the atom, or -1.
  int find(const AtomKey& atom) const;
  /// Number of the atom, which is added if it is new.
  int add(const AtomKey& atom);

  std::size_t size() const { return atoms_.size(); }
  const AtomKey& operator[](int atom) const { return atoms_[static_cast<std::size_t>(atom)]; }

  /// From now on the atom is in the lists.
  void list(int atom);
  const std::vector<int>& with_predicate(int predicate) const;
  const std::vector<int>& with_argument(int predicate, std::size_t position, int object) const;

private:
  struct Hash {
    std::size_t operator()(const AtomKey& x) const;
  };

  std::size_t objects_;
  std::unordered_map<AtomKey, int, Hash> numbers_;
  std::vector<AtomKey> atoms_;
  std::vector<std::vector<int>> of_predicate_;
  std::unordered_map<std::uint64_t, std::vector<int>> of_argument_;
};

/// "If the body is reached, then the heads are", for all values of the slots.
struct ReachabilityRule {
  /// Type of each slot.
  std::vector<int> types;
  /// Slots that need a value.
  std::vector<int> slots;
  /// Without negation.
  std::vector<Literal> body;
  /// Negated literals of predicates that never change, and equality.
  std::vector<Literal> constraints;
  std::vector<Literal> heads;
};

/// Values of a rule's slots, -1 for slots that it does not use.
struct RuleInstance {
  std::size_t rule = 0;
  std::vector<int> values;
};

/// Computes what is reached from the initial atoms, one new atom after the other. The literal with
/// the fewest matching atoms is joined next, so static predicates restrict early.
class Reachability {
public:
  /// @param can_change whether the predicate's atoms can be reached later
  Reachability(const LiftedTask& task, std::vector<bool> can_change,
               std::vector<ReachabilityRule> rules, LimitWatch& watch);

  /// \throws LimitError
  void run(const std::vector<AtomKey>& initial);

  const AtomTable& atoms() const { return atoms_; }
  const std::vector<RuleInstance>& instances() const { return instances_; }

private:
  void trigger(int atom);
  void join(std::size_t rule);
  bool bind(const ReachabilityRule& rule, const Literal& literal, const AtomKey& atom,
            std::vector<int>& bound);
  const std::vector<int>& candidates(const Literal& literal) const;
  void bind_free(std::size_t rule, std::size_t next);
  void finish(std::size_t rule);
  bool holds(const Literal& constraint) const;

  int value_of(Term term) const {
    return is_variable(term) ? values_[static_cast<std::size_t>(term)] : ~term;
  }

  struct InstanceHash {
    const std::vector<RuleInstance>* instances;
    std::size_t operator()(std::size_t x) const;
  };

  const LiftedTask& task_;
  std::vector<bool> can_change_;
  std::vector<ReachabilityRule> rules_;
  LimitWatch& watch_;
  /// Whether an object is of a type.
  std::vector<std::vector<bool>> is_member_;
  AtomTable atoms_;
  /// Rule and position in its body, by predicate.
  std::vector<std::vector<std::pair<std::size_t, std::size_t>>> triggers_;
  std::vector<int> values_;
  std::vector<bool> is_joined_;
  std::vector<RuleInstance> instances_;
  /// Hash of an instance, to the instances with it.
  std::unordered_multimap<std::size_t, std::size_t> known_;
  std::size_t bytes_ = 0;
};

} // namespace castor::planning
