#pragma once

#include "castor/planning/symbolic/lifted_task.hpp"
#include "castor/planning/symbolic/limits.hpp"
#include "castor/planning/symbolic/tuple_table.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

namespace castor::planning {

/// Numbers for atoms without variables, and lists of those with a certain argument.
class AtomTable {
public:
  AtomTable(std::size_t predicates, std::size_t objects);

  /// Number of the atom, or -1.
  int find(std::span<const int> atom) const { return atoms_.find(atom); }
  /// Number of the atom, which is added if it is new.
  int add(std::span<const int> atom) { return atoms_.add(atom).first; }

  std::size_t size() const { return atoms_.size(); }
  /// As an AtomKey; valid until an atom is added.
  std::span<const int> operator[](int atom) const { return atoms_[static_cast<std::size_t>(atom)]; }

  /// From now on the atom is in the lists.
  void list(int atom);
  const std::vector<int>& with_predicate(int predicate) const;
  const std::vector<int>& with_argument(int predicate, std::size_t position, int object) const;

private:
  std::size_t objects_;
  TupleTable atoms_;
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
  std::span<const int> values;
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
  std::size_t instance_count() const { return instances_.size(); }
  RuleInstance instance(std::size_t number) const {
    const auto tuple = instances_[number];
    return {static_cast<std::size_t>(tuple.front()), tuple.subspan(1)};
  }

private:
  void trigger(int atom);
  void join(std::size_t rule);
  bool bind(const ReachabilityRule& rule, const Literal& literal, std::span<const int> atom,
            std::vector<int>& bound);
  const std::vector<int>& candidates(const Literal& literal) const;
  void bind_free(std::size_t rule, std::size_t next);
  void finish(std::size_t rule);
  bool holds(const Literal& constraint) const;

  int value_of(Term term) const {
    return is_variable(term) ? values_[static_cast<std::size_t>(term)] : ~term;
  }

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
  /// Rule and values.
  TupleTable instances_;
  std::size_t bytes_ = 0;
};

} // namespace castor::planning
