// The assignment of detections to people, against all permutations.

#include "castor/mapping/people/assignment.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace castor::mapping {

namespace {

constexpr double never = std::numeric_limits<double>::infinity();

using Quality = std::pair<int, double>;

/// Number of rows without a column, and the sum of costs of the others.
Quality best_of_all(const CostMatrix& costs) {
  const auto rows = costs.size();
  std::vector<std::size_t> order(rows + costs.front().size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  Quality best{1000, 0};
  do {
    Quality x{0, 0};
    for (std::size_t i = 0; i < rows; ++i)
      if (order[i] < costs[i].size() && std::isfinite(costs[i][order[i]]))
        x.second += costs[i][order[i]];
      else
        ++x.first;
    best = std::min(best, x);
  } while (std::next_permutation(order.begin(), order.end()));
  return best;
}

} // namespace

TEST(Assignment, TakesTheLeastSumNotTheNearestFirst) {
  const auto x = assign({{1, 2}, {2, 9}});
  EXPECT_EQ(x[0], 1u);
  EXPECT_EQ(x[1], 0u);
}

TEST(Assignment, LeavesOutWhatIsForbidden) {
  const auto x = assign({{never, 3}, {never, 1}});
  EXPECT_FALSE(x[0]);
  EXPECT_EQ(x[1], 1u);
  EXPECT_TRUE(assign({}).empty());
  EXPECT_FALSE(assign({{}})[0]);
}

RC_GTEST_PROP(AssignmentProperties, IsTheBestOfAll, ()) {
  const auto rows = *rc::gen::inRange<std::size_t>(1, 5);
  const auto columns = *rc::gen::inRange<std::size_t>(1, 4);
  CostMatrix costs(rows, std::vector<double>(columns));
  for (auto& row : costs)
    for (auto& x : row) {
      const int cost = *rc::gen::inRange(0, 30);
      x = cost > 20 ? never : cost;
    }
  Quality found{0, 0};
  std::vector<bool> used(columns);
  const auto result = assign(costs);
  for (std::size_t i = 0; i < rows; ++i) {
    if (!result[i]) {
      ++found.first;
      continue;
    }
    RC_ASSERT(!used[*result[i]]);
    used[*result[i]] = true;
    found.second += costs[i][*result[i]];
  }
  RC_ASSERT(found == best_of_all(costs));
}

} // namespace castor::mapping
