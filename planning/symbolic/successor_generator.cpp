#include "castor/planning/symbolic/successor_generator.hpp"

#include <algorithm>
#include <numeric>

namespace castor::planning {

SuccessorGenerator::SuccessorGenerator(const Task& task, LimitWatch& watch) {
  std::vector<int> sorted(task.operators.size());
  std::iota(sorted.begin(), sorted.end(), 0);
  std::ranges::stable_sort(sorted, {}, [&](int x) -> const std::vector<Fact>& {
    return task.operators[static_cast<std::size_t>(x)].precondition;
  });
  build(task, sorted, 0, sorted.size(), 0, watch);
}

int SuccessorGenerator::build(const Task& task, const std::vector<int>& sorted, std::size_t begin,
                              std::size_t end, std::size_t depth, LimitWatch& watch) {
  watch.check();
  const auto precondition = [&](std::size_t i) -> const std::vector<Fact>& {
    return task.operators[static_cast<std::size_t>(sorted[i])].precondition;
  };
  const int first = static_cast<int>(nodes_.size());
  int node = first;
  nodes_.emplace_back();
  for (; begin < end && precondition(begin).size() == depth; ++begin)
    nodes_.back().operators.push_back(sorted[begin]);
  while (begin < end) {
    const int variable = precondition(begin)[depth].variable;
    std::vector<int> children(
      static_cast<std::size_t>(task.domain_sizes[static_cast<std::size_t>(variable)]), -1);
    while (begin < end && precondition(begin)[depth].variable == variable) {
      const int value = precondition(begin)[depth].value;
      auto last = begin;
      while (last < end && precondition(last)[depth] == Fact{variable, value})
        ++last;
      children[static_cast<std::size_t>(value)] =
        build(task, sorted, begin, last, depth + 1, watch);
      begin = last;
    }
    int others = -1;
    if (begin < end) {
      others = static_cast<int>(nodes_.size());
      nodes_.emplace_back();
    }
    auto& done = nodes_[static_cast<std::size_t>(node)];
    done.variable = variable;
    done.children = std::move(children);
    done.others = others;
    node = others;
  }
  return first;
}

void SuccessorGenerator::visit(int node, const State& state, std::vector<int>& result) const {
  while (node >= 0) {
    const auto& x = nodes_[static_cast<std::size_t>(node)];
    result.insert(result.end(), x.operators.begin(), x.operators.end());
    if (x.variable < 0)
      return;
    const auto value = static_cast<std::size_t>(state[static_cast<std::size_t>(x.variable)]);
    if (x.children[value] >= 0)
      visit(x.children[value], state, result);
    node = x.others;
  }
}

} // namespace castor::planning
