#include "castor/actors/runtime/keeper.hpp"

#include "castor/tools/simulation/testing_system.hpp"

#include <caf/event_based_actor.hpp>
#include <caf/send.hpp>

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
  DeletionWatch::Clock::time_point now{1000s};
  watch.check(all, now);
  for (std::size_t i = 0; i < deletions.size(); ++i) {
    all += deletions[i];
    for (int j = 0; j < 4; ++j)
      if (watch.check(all, now += 250ms))
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

class KeptLeases : public testing::Test, protected simulation::TestingSystem {
protected:
  KeptLeases() {
    component->set_budget(5s);
    const auto wm = system.spawn([this]() -> caf::behavior {
      return {[this](const RenewRequest& x) {
        renewed += x.leases.size();
        return RenewReply{};
      }};
    });
    KeeperParts parts;
    parts.components = {component};
    parts.working_memories["a"] = caf::actor_cast<WorkingMemoryActor>(wm);
    actor = system.spawn(keeper, std::move(parts));
    actors = {actor, wm};
    scheduler.run();
  }

  ~KeptLeases() override {
    for (auto& x : actors)
      caf::anon_send_exit(x, caf::exit_reason::user_shutdown);
    scheduler.run();
  }

  /// Lets time pass in steps, as many timers were set while it passes.
  void pass(std::chrono::milliseconds duration) {
    for (auto left = duration; left > 0ms; left -= 50ms) {
      scheduler.advance_time(50ms);
      scheduler.run();
    }
  }

  std::shared_ptr<ComponentRecord> component =
    std::make_shared<ComponentRecord>(ComponentIdentity{"thinker", "a", "Thinker", 0});
  std::size_t renewed = 0;
  caf::actor actor;
  std::vector<caf::actor> actors;
};

TEST_F(KeptLeases, AreRenewedFourTimesASecond) {
  component->leases.add({"a", "1"}, 7);
  pass(10s);
  EXPECT_NEAR(static_cast<double>(renewed), 40, 2);
}

TEST_F(KeptLeases, AreRenewedSoonAfterARest) {
  for (LeaseToken token = 1; token <= 20; ++token) {
    pass(2s + 50ms * token);
    ASSERT_EQ(renewed, 0u);
    component->leases.add({"a", "1"}, token);
    pass(300ms);
    EXPECT_EQ(renewed, 1u);
    component->leases.release({"a", "1"}, token);
    renewed = 0;
  }
}

TEST_F(KeptLeases, WithoutAnyTheKeeperRests) {
  pass(5s);
  auto& timers = scheduler.clock().schedule();
  ASSERT_EQ(timers.size(), 1u);
  const auto first = timers.begin()->first;
  pass(2s);
  ASSERT_EQ(timers.size(), 1u);
  EXPECT_EQ(timers.begin()->first - first, 2s);
  component->enter_user_code(scheduler.clock().now() - 1ms);
  pass(2s);
  ASSERT_EQ(timers.size(), 1u);
  EXPECT_LE(timers.begin()->first - scheduler.clock().now(), 250ms) << "its budget is watched";
}

TEST_F(KeptLeases, AShortBudgetMakesTheRestShort) {
  component->set_budget(500ms);
  pass(5s);
  ASSERT_EQ(scheduler.clock().schedule().size(), 1u);
  EXPECT_LE(scheduler.clock().schedule().begin()->first - scheduler.clock().now(), 500ms);
}

} // namespace

} // namespace castor
