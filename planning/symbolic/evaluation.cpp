#include "castor/planning/symbolic/evaluation.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace castor::planning {

namespace {

int object_of(Term term, const std::vector<int>& values) {
  return is_variable(term) ? values[static_cast<std::size_t>(term)] : ~term;
}

class Evaluation {
public:
  Evaluation(const LiftedTask& task, const std::vector<Variable>& variables,
             std::vector<int> values, const AtomSet& state)
    : task_(task), variables_(variables), state_(state), values_(std::move(values)) {
    values_.resize(variables.size(), -1);
  }

  bool holds(const Formula& x) {
    using Kind = Formula::Kind;
    const auto part_holds = [&](const Formula& part) { return holds(part); };
    switch (x.kind) {
      case Kind::literal:
        return holds(x.literal);
      case Kind::conjunction:
        return std::ranges::all_of(x.parts, part_holds);
      case Kind::disjunction:
        return std::ranges::any_of(x.parts, part_holds);
      case Kind::forall:
      case Kind::exists:
        return holds_for(x, 0);
    }
    return false;
  }

private:
  bool holds(const Literal& x) const {
    const bool is_true = x.predicate == equality ? object_of(x.arguments[0], values_) ==
                                                     object_of(x.arguments[1], values_)
                                                 : state_.contains(ground_atom(x, values_));
    return is_true != x.is_negated;
  }

  bool holds_for(const Formula& x, std::size_t next) {
    if (next == x.variables.size())
      return holds(x.parts.front());
    const auto slot = static_cast<std::size_t>(x.variables[next]);
    for (const int object : task_.types[static_cast<std::size_t>(variables_[slot].type)].objects) {
      values_[slot] = object;
      const bool is_true = holds_for(x, next + 1);
      if (is_true == (x.kind == Formula::Kind::exists))
        return is_true;
    }
    return x.kind == Formula::Kind::forall;
  }

  const LiftedTask& task_;
  const std::vector<Variable>& variables_;
  const AtomSet& state_;
  std::vector<int> values_;
};

} // namespace

AtomKey ground_atom(const Literal& literal, const std::vector<int>& values) {
  AtomKey result{literal.predicate};
  for (const Term x : literal.arguments)
    result.push_back(object_of(x, values));
  return result;
}

bool holds(const LiftedTask& task, const Formula& condition, const std::vector<Variable>& variables,
           std::vector<int> values, const AtomSet& state) {
  return Evaluation(task, variables, std::move(values), state).holds(condition);
}

} // namespace castor::planning
