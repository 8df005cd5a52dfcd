#include "castor/mapping/graph/shortest_path.hpp"

#include <algorithm>
#include <functional>
#include <queue>
#include <unordered_map>
#include <utility>

namespace castor::mapping {

GraphWay shortest_way(std::span<const GraphEdge> edges, std::int64_t from, std::int64_t to) {
  if (from == to)
    return {{from}, 0};
  std::unordered_map<std::int64_t, std::vector<std::pair<std::int64_t, double>>> ways;
  for (auto& x : edges) {
    ways[x.a].emplace_back(x.b, x.cost);
    ways[x.b].emplace_back(x.a, x.cost);
  }
  struct Reached {
    double cost = 0;
    std::int64_t before = -1;
    bool is_final = false;
  };
  std::unordered_map<std::int64_t, Reached> reached;
  using Step = std::pair<double, std::int64_t>;
  std::priority_queue<Step, std::vector<Step>, std::greater<>> open;
  reached[from] = {};
  open.emplace(0, from);
  while (!open.empty()) {
    const auto [cost, node] = open.top();
    open.pop();
    if (std::exchange(reached[node].is_final, true))
      continue;
    if (node == to)
      break;
    for (auto& [next, length] : ways[node]) {
      auto [x, is_new] = reached.try_emplace(next);
      if (!is_new && x->second.cost <= cost + length)
        continue;
      x->second.cost = cost + length;
      x->second.before = node;
      open.emplace(cost + length, next);
    }
  }
  auto last = reached.find(to);
  if (last == reached.end())
    return {};
  GraphWay result{{to}, last->second.cost};
  while (result.nodes.back() != from)
    result.nodes.push_back(reached[result.nodes.back()].before);
  std::ranges::reverse(result.nodes);
  return result;
}

} // namespace castor::mapping
