#include "castor/mapping/people/joint_assignment.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace castor::mapping {

namespace {

/// Partial solutions that are looked at in a group at most; then the best so far counts. The first
/// that is found is the greedy one.
constexpr int most_nodes = 100'000;

using Targets = std::vector<std::vector<Explanation>>;

/// The best explanation of a group of targets.
class GroupSearch {
public:
  GroupSearch(const Targets& targets, std::vector<std::size_t> group, std::size_t parts)
    : targets_(targets), group_(std::move(group)), used_(parts), least_left_(group_.size() + 1),
      order_(group_.size()), chosen_(group_.size()) {
    for (std::size_t i = group_.size(); i-- > 0;) {
      const auto& options = targets_[group_[i]];
      auto& order = order_[i];
      order.resize(options.size());
      std::iota(order.begin(), order.end(), std::size_t{0});
      std::ranges::sort(order, {}, [&](std::size_t x) { return options[x].cost; });
      least_left_[i] = least_left_[i + 1] + options[order.front()].cost;
    }
  }

  void run(std::vector<std::size_t>& result) {
    search(0, 0);
    for (std::size_t i = 0; i < group_.size(); ++i)
      result[group_[i]] = best_[i];
  }

private:
  void search(std::size_t at, double cost) {
    if (at == group_.size()) {
      best_cost_ = cost;
      best_ = chosen_;
      return;
    }
    const auto& options = targets_[group_[at]];
    for (const auto position : order_[at]) {
      const auto& x = options[position];
      const bool is_too_dear = cost + x.cost + least_left_[at + 1] >= best_cost_;
      if (is_too_dear || (nodes_ >= most_nodes && !best_.empty()))
        return;
      if (std::ranges::any_of(x.all_parts(), [&](std::size_t part) { return used_[part]; }))
        continue;
      ++nodes_;
      chosen_[at] = position;
      for (const auto part : x.all_parts())
        used_[part] = true;
      search(at + 1, cost + x.cost);
      for (const auto part : x.all_parts())
        used_[part] = false;
    }
  }

  const Targets& targets_;
  std::vector<std::size_t> group_;
  std::vector<bool> used_;
  /// Least cost of the targets from that one on.
  std::vector<double> least_left_;
  /// Positions of explanations by cost.
  std::vector<std::vector<std::size_t>> order_;
  std::vector<std::size_t> chosen_;
  std::vector<std::size_t> best_;
  double best_cost_ = std::numeric_limits<double>::infinity();
  int nodes_ = 0;
};

/// Targets that compete for parts, directly or through others.
std::vector<std::vector<std::size_t>> groups_of(const Targets& targets, std::size_t parts) {
  std::vector<std::size_t> root(targets.size());
  std::iota(root.begin(), root.end(), std::size_t{0});
  const auto find = [&](std::size_t x) {
    while (root[x] != x)
      x = root[x] = root[root[x]];
    return x;
  };
  std::vector<std::size_t> owner(parts, targets.size());
  for (std::size_t i = 0; i < targets.size(); ++i)
    for (const auto& x : targets[i])
      for (const auto part : x.all_parts()) {
        if (owner[part] == targets.size())
          owner[part] = i;
        root[find(i)] = find(owner[part]);
      }
  std::vector<std::vector<std::size_t>> result(targets.size());
  for (std::size_t i = 0; i < targets.size(); ++i)
    result[find(i)].push_back(i);
  std::erase_if(result, [](auto& x) { return x.empty(); });
  return result;
}

} // namespace

std::vector<std::size_t> explain_jointly(const Targets& targets) {
  std::size_t parts = 0;
  for (const auto& options : targets)
    for (const auto& x : options)
      for (const auto part : x.all_parts())
        parts = std::max(parts, part + 1);
  std::vector<std::size_t> result(targets.size());
  for (auto& group : groups_of(targets, parts))
    GroupSearch(targets, std::move(group), parts).run(result);
  return result;
}

} // namespace castor::mapping
