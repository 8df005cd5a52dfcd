#pragma once

#include "castor/planning/symbolic/task.hpp"

#include <cstddef>
#include <vector>

namespace castor::planning {

/// Decision tree over the variables of preconditions (Helmert 2006, section 5.3.1): finds the
/// applicable operators without looking at all of them.
class SuccessorGenerator {
public:
  /// \throws LimitError
  SuccessorGenerator(const Task& task, LimitWatch& watch);

  /// Appends the indices of the operators that are applicable in the state.
  void applicable(const State& state, std::vector<int>& result) const { visit(0, state, result); }

private:
  struct Node {
    /// -1 if no further variable decides.
    int variable = -1;
    /// By value of the variable; -1 for none.
    std::vector<int> children;
    /// Operators to which the variable does not matter; -1 for none.
    int others = -1;
    std::vector<int> operators;
  };

  int build(const Task& task, const std::vector<int>& sorted, std::size_t begin, std::size_t end,
            std::size_t depth, LimitWatch& watch);
  void visit(int node, const State& state, std::vector<int>& result) const;

  std::vector<Node> nodes_;
};

} // namespace castor::planning
