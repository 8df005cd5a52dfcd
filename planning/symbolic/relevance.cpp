#include "castor/planning/symbolic/relevance.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace castor::planning {

namespace {

/// Predicates that the goal depends on, by their indices.
class Relevance {
public:
  explicit Relevance(const NormalTask& task) : task_(task), is_relevant_(task.predicates.size()) {
    need(task.goal);
    while (has_grown_) {
      has_grown_ = false;
      for (const auto& x : task_.axioms)
        if (is_relevant(x.predicate))
          need(x.body.literals);
      for (const auto& x : task_.actions)
        need_conditions(x);
    }
  }

  bool is_relevant(int predicate) const {
    return predicate == equality || is_relevant_[static_cast<std::size_t>(predicate)];
  }

  bool is_relevant(const NormalAction& x) const {
    return std::ranges::any_of(
      x.effects, [this](const auto& effect) { return is_relevant(effect.literal.predicate); });
  }

private:
  void need(const std::vector<Literal>& literals) {
    for (const auto& x : literals)
      if (!is_relevant(x.predicate)) {
        is_relevant_[static_cast<std::size_t>(x.predicate)] = true;
        has_grown_ = true;
      }
  }

  void need_conditions(const NormalAction& x) {
    if (!is_relevant(x))
      return;
    need(x.precondition.literals);
    for (const auto& effect : x.effects)
      if (is_relevant(effect.literal.predicate))
        need(effect.condition.literals);
  }

  const NormalTask& task_;
  std::vector<bool> is_relevant_;
  bool has_grown_ = true;
};

} // namespace

void remove_irrelevant(NormalTask& task) {
  const Relevance relevance{task};
  std::erase_if(task.axioms, [&](const auto& x) { return !relevance.is_relevant(x.predicate); });
  std::erase_if(task.actions, [&](const auto& x) { return !relevance.is_relevant(x); });
  for (auto& action : task.actions)
    std::erase_if(action.effects, [&](const auto& effect) {
      return !relevance.is_relevant(effect.literal.predicate);
    });
}

} // namespace castor::planning
