#include "castor/actors/faults/random_plan.hpp"

#include "castor/tests/faults/support.hpp"

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include <set>

namespace castor::faults {

namespace {

using namespace std::chrono_literals;

std::set<std::size_t> kinds_in(const FaultPlan& x) {
  std::set<std::size_t> result;
  for (auto& statement : x.statements)
    result.insert(statement.faults.front().index());
  return result;
}

RC_GTEST_PROP(RandomPlan, FitsTheSystemAndLeavesItToRest, (std::uint64_t seed)) {
  auto duration = *rc::gen::map(rc::gen::inRange<std::int64_t>(1, 100'000'000),
                                [](auto x) { return Timestamp{x}; });
  auto& targets = seed % 2 == 0 ? test::table_top() : test::small_system();
  auto plan = random_plan(targets, seed, duration);
  RC_ASSERT(cast::render(check_plan(plan, targets)) == "");
  RC_ASSERT(test::plan_of(to_string(plan)) == plan);
  auto rest = std::min<Timestamp>(10s, duration / 4);
  for (auto& x : plan.statements) {
    auto at = std::get<At>(x.trigger).time;
    RC_ASSERT(x.faults.size() == 1U);
    RC_ASSERT(at < duration - rest);
    RC_ASSERT(at + duration_of(x.faults.front()).value_or(Timestamp{0}) <= duration - rest);
    RC_ASSERT(to_string(x.faults.front()).find("any ") == std::string::npos);
  }
}

TEST(RandomPlan, HasEverythingThatCanBefallTheSystemAndAnEndToIt) {
  auto plan = random_plan(test::table_top(), 1, 2000s);
  auto kinds = kinds_in(plan);
  // All but `continue`: stops end by themselves.
  EXPECT_EQ(kinds.size(), std::variant_size_v<Fault> - 1);
  EXPECT_GT(plan.statements.size(), 800U);
  EXPECT_LT(plan.statements.size(), 1200U);
}

TEST(RandomPlan, HasNothingForWhatIsNotThere) {
  EXPECT_TRUE(random_plan({}, 1, 100s).statements.empty());
  auto text = to_string(random_plan(test::small_system(), 1, 2000s));
  for (auto absent : {"kill", "stop", "link", "between", "journal", "only_wm"})
    EXPECT_EQ(text.find(absent), std::string::npos) << absent;
}

TEST(RandomPlan, FollowsFromTheSeed) {
  EXPECT_EQ(random_plan(test::table_top(), 3, 60s), random_plan(test::table_top(), 3, 60s));
  EXPECT_FALSE(random_plan(test::table_top(), 3, 60s).statements ==
               random_plan(test::table_top(), 4, 60s).statements);
}

} // namespace

} // namespace castor::faults
