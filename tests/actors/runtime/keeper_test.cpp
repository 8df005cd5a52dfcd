#include "castor/actors/runtime/keeper.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <memory>
#include <vector>

namespace castor {

namespace {

using namespace std::chrono_literals;

struct Budgets : testing::Test {
  std::shared_ptr<ComponentRecord> component =
    std::make_shared<ComponentRecord>(ComponentIdentity{"thinker", "a", "Thinker", 0});
  BudgetWatch watch{{component}};
  ComponentRecord::Clock::time_point start{1000s};

  void SetUp() override { component->set_budget(5s); }
};

TEST_F(Budgets, AreKeptByAComponentThatWaits) {
  component->enter_user_code(start);
  component->set_idle();
  EXPECT_TRUE(watch.check(start + 1h).empty());
}

TEST_F(Budgets, AnOverrunIsReportedOnce) {
  component->enter_user_code(start);
  EXPECT_TRUE(watch.check(start + 5s).empty());
  auto overruns = watch.check(start + 6s);
  ASSERT_EQ(overruns.size(), 1u);
  EXPECT_EQ(overruns[0].component, component.get());
  EXPECT_EQ(overruns[0].duration, 6s);
  EXPECT_TRUE(watch.check(start + 7s).empty());
}

TEST_F(Budgets, ASecondOverrunIsReportedAgain) {
  component->enter_user_code(start);
  ASSERT_EQ(watch.check(start + 6s).size(), 1u);
  component->leave_user_code();
  EXPECT_TRUE(watch.check(start + 7s).empty());
  component->enter_user_code(start + 8s);
  EXPECT_TRUE(watch.check(start + 9s).empty());
  EXPECT_EQ(watch.check(start + 14s).size(), 1u);
}

TEST_F(Budgets, AnOperationCountsAsAPause) {
  component->enter_user_code(start);
  component->leave_user_code();
  component->enter_user_code(start + 4s);
  EXPECT_TRUE(watch.check(start + 8s).empty());
  EXPECT_EQ(component->busy_for(start + 8s), 8s) << "though it was busy all the while";
}

/// Seconds, each with so many deletions, after which memory was given back.
std::vector<int> given_back(const std::vector<std::uint64_t>& deletions) {
  DeletionWatch watch;
  std::vector<int> result;
  std::uint64_t all = 7'000'000;
  watch.check(all);
  for (std::size_t i = 0; i < deletions.size(); ++i) {
    all += deletions[i];
    for (int j = 0; j < DeletionWatch::checks_per_second; ++j)
      if (watch.check(all))
        result.push_back(static_cast<int>(i));
  }
  return result;
}

TEST(DeletionWatch, MemoryIsGivenBackOnceAfterManyDeletions) {
  EXPECT_EQ(given_back({50'000, 50'000, 0, 0, 0}), std::vector<int>{2});
  EXPECT_EQ(given_back({50'000, 900, 900}), std::vector<int>{1}) << "few are as good as none";
}

TEST(DeletionWatch, FewDeletionsAreNotWorthIt) {
  EXPECT_EQ(given_back({5'000, 0, 0, 0}), std::vector<int>{});
  EXPECT_EQ(given_back({6'000, 0, 6'000, 0, 0}), std::vector<int>{3}) << "but count";
}

TEST(DeletionWatch, EntriesThatComeAndGoKeepTheirMemory) {
  EXPECT_EQ(given_back(std::vector<std::uint64_t>(100, 20'000)), std::vector<int>{});
}

} // namespace

} // namespace castor
