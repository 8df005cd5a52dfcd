// The joint explanation of all people by the parts that were detected, against all combinations.

#include "castor/mapping/people/joint_assignment.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

namespace castor::mapping {

namespace {

using Targets = std::vector<std::vector<Explanation>>;

Explanation nothing(double cost) {
  return {cost, {}, 0};
}
Explanation one(double cost, std::size_t part) {
  return {cost, {part, 0}, 1};
}
Explanation two(double cost, std::size_t a, std::size_t b) {
  return {cost, {a, b}, 2};
}

/// Sum of costs; infinite if a part belongs to two.
double cost_of(const Targets& targets, const std::vector<std::size_t>& chosen, std::size_t parts) {
  std::vector<int> used(parts);
  double result = 0;
  for (std::size_t i = 0; i < targets.size(); ++i) {
    const auto& x = targets[i][chosen[i]];
    result += x.cost;
    for (const auto part : x.all_parts())
      if (++used[part] > 1)
        return std::numeric_limits<double>::infinity();
  }
  return result;
}

double least_of_all(const Targets& targets, std::size_t parts) {
  std::vector<std::size_t> chosen(targets.size());
  double best = std::numeric_limits<double>::infinity();
  while (true) {
    best = std::min(best, cost_of(targets, chosen, parts));
    std::size_t i = 0;
    while (i < chosen.size() && ++chosen[i] == targets[i].size())
      chosen[i++] = 0;
    if (i == chosen.size())
      return best;
  }
}

} // namespace

TEST(JointAssignment, TakesTheLeastSumNotTheNearestFirst) {
  const Targets targets{{nothing(9), one(1, 0), one(2, 1)}, {nothing(9), one(2, 0), one(8, 1)}};
  EXPECT_EQ(explain_jointly(targets), (std::vector<std::size_t>{2, 1}));
}

TEST(JointAssignment, LeavesOneLegToSomebodyElse) {
  const Targets targets{{nothing(5), one(0, 0), two(-1, 0, 1)}, {nothing(5), one(0, 1)}};
  EXPECT_EQ(explain_jointly(targets), (std::vector<std::size_t>{1, 1}));
}

TEST(JointAssignment, SomebodyIsHiddenBehindAPersonWithTwoLegs) {
  const Targets targets{{nothing(5), one(0, 0), two(-3, 0, 1)}, {nothing(0.1), one(0, 1)}};
  EXPECT_EQ(explain_jointly(targets), (std::vector<std::size_t>{2, 0}));
}

RC_GTEST_PROP(JointAssignmentProperties, IsTheBestOfAll, ()) {
  constexpr std::size_t parts = 4;
  Targets targets(*rc::gen::inRange<std::size_t>(1, 5));
  const auto cost = [] { return *rc::gen::inRange(-20, 20) / 4.0; };
  for (auto& options : targets) {
    options.push_back(nothing(cost()));
    const auto more = *rc::gen::inRange(0, 4);
    for (int i = 0; i < more; ++i) {
      const auto a = *rc::gen::inRange<std::size_t>(0, parts);
      const auto b = *rc::gen::inRange<std::size_t>(0, parts);
      options.push_back(a == b ? one(cost(), a) : two(cost(), a, b));
    }
  }
  RC_ASSERT(cost_of(targets, explain_jointly(targets), parts) == least_of_all(targets, parts));
}

} // namespace castor::mapping
