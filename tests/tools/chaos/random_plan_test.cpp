#include "castor/tools/chaos/random_plan.hpp"

#include "castor/tests/tools/chaos/support.hpp"

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

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
  RC_ASSERT(render(check_plan(plan, targets)) == "");
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

TEST(RandomPlan, HasEveryKindOfFaultThatTheSystemHasTargetsForAndAnEndOfEach) {
  auto targets = test::table_top();
  targets.subarchitectures.front().goes_on_without_journal = true;
  RandomPlanOptions options;
  options.within_restart_limits = false;
  auto plan = random_plan(targets, 1, 2000s, options);
  auto kinds = kinds_in(plan);
  // All but `continue`, since stops end by themselves, and what links as streams cannot do.
  EXPECT_EQ(kinds.size(), std::variant_size_v<Fault> - 3);
  EXPECT_GT(plan.statements.size(), 800U);
  EXPECT_LT(plan.statements.size(), 1200U);
}

TEST(RandomPlan, KillsAndStopsIsolatedComponentsAsWellAsNodes) {
  auto text = to_string(random_plan(test::table_top(), 1, 2000s));
  for (auto fault : {"kill tracker\n", "kill node1\n", "stop tracker for ", "stop node1 for "})
    EXPECT_NE(text.find(fault), std::string::npos) << fault;
}

TEST(RandomPlan, ComponentsWhoseStartIsBlockedAreStartedAgain) {
  auto plan = random_plan(test::table_top(), 1, 2000s);
  auto blocks = 0;
  for (std::size_t i = 0; i < plan.statements.size(); ++i)
    if (auto block = std::get_if<Block>(&plan.statements[i].faults.front())) {
      ++blocks;
      ASSERT_LT(i + 1, plan.statements.size());
      auto& next = plan.statements[i + 1];
      EXPECT_EQ(next.trigger, plan.statements[i].trigger);
      EXPECT_EQ(next.faults.front(), Fault{Crash{block->component}});
    }
  EXPECT_GT(blocks, 0);
}

TEST(RandomPlan, RemovesOnlyJournalsThatAWorkingMemoryCanDoWithout) {
  EXPECT_EQ(to_string(random_plan(test::table_top(), 1, 2000s)).find("remove"), std::string::npos);
}

TEST(RandomPlan, HasNothingForWhatIsNotThere) {
  EXPECT_TRUE(random_plan({}, 1, 100s).statements.empty());
  auto text = to_string(random_plan(test::small_system(), 1, 2000s));
  EXPECT_NE(text, "");
  for (auto absent : {"kill", "stop", "link", "between", "journal", "only_wm"})
    EXPECT_EQ(text.find(absent), std::string::npos) << absent;
}

/// How many failures a supervisor is asked to bear within its period, at most: of components of a
/// subarchitecture, or of stand-alone ones if that is empty.
std::size_t most_failures_within(const FaultPlan& plan, const FaultTargets& targets,
                                 const std::string& supervisor, Timestamp period) {
  std::vector<Timestamp> failures;
  for (auto& x : plan.statements) {
    auto& fault = x.faults.front();
    auto name = std::holds_alternative<FailJournal>(fault)
                  ? working_memory_of(std::get<FailJournal>(fault).memory.subarchitecture)
                  : target_of(fault);
    auto fails = std::holds_alternative<Crash>(fault) || std::holds_alternative<Throw>(fault) ||
                 std::holds_alternative<FailJournal>(fault) ||
                 (std::holds_alternative<Kill>(fault) && name == "tracker");
    if (fails && targets.supervisor_of(name) == supervisor)
      failures.push_back(std::get<At>(x.trigger).time);
  }
  std::size_t result = 0;
  for (auto first : failures)
    result = std::max(result, static_cast<std::size_t>(std::ranges::count_if(failures, [&](auto x) {
                        return x >= first && x < first + period;
                      })));
  return result;
}

RC_GTEST_PROP(RandomPlan, AsksNoSupervisorForMoreRestartsThanItAllows, (std::uint64_t seed)) {
  auto targets = test::table_top();
  targets.system_limit = {1, 10s};
  targets.subarchitectures[0].limit = {3, 10s};
  targets.subarchitectures[1].limit = {2, 5s};
  auto plan = random_plan(targets, seed, 300s);
  RC_ASSERT(most_failures_within(plan, targets, "", 10s) <= 1U);
  RC_ASSERT(most_failures_within(plan, targets, "vision", 10s) <= 3U);
  RC_ASSERT(most_failures_within(plan, targets, "binding", 5s) <= 2U);
}

TEST(RandomPlan, WithARateOfItsOwnIgnoresTheLimits) {
  RandomPlanOptions options;
  options.interval = 100ms;
  options.within_restart_limits = false;
  options.failures_only = true;
  auto plan = random_plan(test::table_top(), 1, 100s, options);
  EXPECT_GT(most_failures_within(plan, test::table_top(), "vision", 10s), 20U);
  for (auto kind : kinds_in(plan))
    EXPECT_THAT((std::set<std::size_t>{Fault{Crash{}}.index(), Fault{Throw{}}.index(),
                                       Fault{Kill{}}.index(), Fault{FailJournal{}}.index()}),
                testing::Contains(kind));
}

TEST(RandomPlan, GoesToThoseWhoDoMuch) {
  RandomPlanOptions options;
  options.within_restart_limits = false;
  options.activity = ActivityByComponent{{"segmentor", {10, 100}}, {"tracker", {0.01, 0}}};
  auto plan = random_plan(test::table_top(), 1, 2000s, options);
  std::map<std::string, std::size_t> crashes;
  for (auto& x : plan.statements) {
    auto& fault = x.faults.front();
    if (std::holds_alternative<Crash>(fault))
      ++crashes[target_of(fault)];
    // Nobody else has callbacks.
    if (std::holds_alternative<Throw>(fault) || std::holds_alternative<Hang>(fault) ||
        std::holds_alternative<Slow>(fault)) {
      EXPECT_EQ(target_of(fault), "segmentor");
    }
    if (auto thrown = std::get_if<Throw>(&fault)) {
      EXPECT_LE(thrown->callback, 20U);
    }
  }
  EXPECT_GT(crashes["segmentor"], 3 * crashes["binder"]);
  EXPECT_GT(crashes["binder"], 0U);
}

TEST(RandomPlan, WaitsForNoCallbackThatWillHardlyCome) {
  RandomPlanOptions options;
  options.within_restart_limits = false;
  options.activity = ActivityByComponent{{"segmentor", {0.05, 0}}};
  for (auto& x : random_plan(test::table_top(), 1, 60s, options).statements)
    if (auto thrown = std::get_if<Throw>(&x.faults.front())) {
      EXPECT_EQ(thrown->callback, 1U);
    }
}

TEST(RandomPlan, FollowsFromTheSeed) {
  EXPECT_EQ(random_plan(test::table_top(), 3, 60s), random_plan(test::table_top(), 3, 60s));
  EXPECT_FALSE(random_plan(test::table_top(), 3, 60s).statements ==
               random_plan(test::table_top(), 4, 60s).statements);
}

} // namespace

} // namespace castor::faults
