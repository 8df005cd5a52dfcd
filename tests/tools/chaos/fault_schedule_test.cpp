#include "castor/tools/chaos/fault_schedule.hpp"

#include "castor/tests/tools/chaos/random_faults.hpp"
#include "castor/tests/tools/chaos/support.hpp"
#include "castor/wm/values/reflect.hpp"

#include <gmock/gmock.h>
#include <rapidcheck/gtest.h>

#include <set>

namespace castor::faults {

struct ScheduleTestBall {
  double size = 0;
};
CASTOR_REFLECT(ScheduleTestBall, size)

namespace {

using namespace std::chrono_literals;
using test::plan_of;
using test::table_top;

FaultSchedule schedule_of(std::string_view plan, std::uint64_t seed = 1, Timestamp duration = 10s) {
  return {plan_of(plan), table_top(), seed, duration};
}

std::vector<Timestamp> times_of(const FaultSchedule& x) {
  std::vector<Timestamp> result;
  for (auto& fault : x.timed())
    result.push_back(fault.at);
  return result;
}

std::vector<std::string> texts_of(const std::vector<DueFault>& faults) {
  std::vector<std::string> result;
  for (auto& x : faults)
    result.push_back(to_text(x.at) + " " + to_string(x.fault));
  return result;
}

ChangeEvent added_ball(const std::string& subarchitecture) {
  ChangeEvent result;
  result.address = {subarchitecture, "0:1"};
  result.type = descriptor_of<ScheduleTestBall>();
  return result;
}

TEST(SeededRandom, GivesTheSameNumbersEverywhere) {
  // Those of the reference implementation, for the seed 1234567.
  SeededRandom x{1234567};
  EXPECT_EQ(x(), 6457827717110365317U);
  EXPECT_EQ(x(), 3203168211198807973U);
  EXPECT_EQ(x(), 9817491932198370423U);
}

TEST(SeededRandom, StaysBelowABoundAndGivesAllThatIs) {
  SeededRandom x{7};
  std::set<std::uint64_t> seen;
  for (int i = 0; i < 1000; ++i)
    seen.insert(x.below(6));
  EXPECT_THAT(seen, testing::ElementsAre(0, 1, 2, 3, 4, 5));
  for (int i = 0; i < 1000; ++i) {
    auto y = x.between(-2, 2);
    EXPECT_LE(-2, y);
    EXPECT_LE(y, 2);
  }
}

TEST(FaultSchedule, GivesEachFaultOnceAndWhenItIsDue) {
  auto x = schedule_of("at 3s crash tracker\nat 1s crash segmentor\n");
  EXPECT_EQ(x.next_time(), 1s);
  EXPECT_EQ(x.next(999ms), std::nullopt);
  auto first = x.next(5s);
  ASSERT_TRUE(first);
  EXPECT_EQ(first->fault, (Fault{Crash{{"segmentor", {}}}}));
  EXPECT_EQ(first->statement, 1U);
  EXPECT_EQ(x.next_time(), 3s);
  EXPECT_EQ(x.next(5s).value().at, 3s);
  EXPECT_EQ(x.next(5s), std::nullopt);
  EXPECT_EQ(x.next_time(), std::nullopt);
}

TEST(FaultSchedule, RepeatsUntilTheEnd) {
  EXPECT_THAT(times_of(schedule_of("every 4s crash tracker", 1, 12s)),
              testing::ElementsAre(4s, 8s));
  EXPECT_THAT(times_of(schedule_of("at 12s crash tracker", 1, 12s)), testing::IsEmpty());
  EXPECT_THAT(times_of(schedule_of("at 0s crash tracker")), testing::ElementsAre(0s));
}

TEST(FaultSchedule, KeepsTheOrderOfThePlanAtOneTime) {
  EXPECT_THAT(texts_of(schedule_of("at 1s crash tracker\nat 1s crash camera\n").timed()),
              testing::ElementsAre("1s crash tracker", "1s crash camera"));
}

TEST(FaultSchedule, RandomFaultsComeAsOftenAsTheirRate) {
  auto times = times_of(schedule_of("rate 2/s crash tracker", 1, 1000s));
  EXPECT_GT(times.size(), 1800U);
  EXPECT_LT(times.size(), 2200U);
  EXPECT_TRUE(std::ranges::is_sorted(times));
}

TEST(FaultSchedule, DrawsFromAllThatAnyMayBe) {
  auto drawn = [](std::string_view plan) {
    std::set<std::string> result;
    auto schedule = schedule_of(plan, 1, 200s);
    for (auto& x : schedule.timed())
      result.insert(to_string(x.fault));
    return result;
  };
  EXPECT_THAT(
    drawn("every 1s crash any component"),
    testing::ElementsAre("crash binder", "crash camera", "crash segmentor", "crash tracker"));
  EXPECT_THAT(drawn("every 1s crash any component of vision or kill any node"),
              testing::ElementsAre("crash segmentor", "crash tracker", "kill node1", "kill node2"));
  EXPECT_THAT(drawn("every 1s drop 1% on any link").size(), 4U);
  EXPECT_THAT(drawn("every 1s fail journal of any"),
              testing::ElementsAre("fail journal of vision"));
  EXPECT_THAT(drawn("every 1s jump clock of any by 1s").size(), 2U);
}

TEST(FaultSchedule, FollowsFromTheSeed) {
  auto plan = "rate 1/s crash any component or stop any node for 1s";
  EXPECT_EQ(schedule_of(plan, 5).timed(), schedule_of(plan, 5).timed());
  EXPECT_NE(schedule_of(plan, 5).timed(), schedule_of(plan, 6).timed());
  // What it was when this was written, on whatever machine.
  EXPECT_THAT(texts_of(schedule_of(plan, 5, 4s).timed()),
              testing::ElementsAre("1875ms stop node2 for 1s", "1891ms crash segmentor",
                                   "2423ms crash tracker", "3011ms stop node1 for 1s"));
}

TEST(FaultSchedule, StatementsDoNotDisturbEachOther) {
  auto line = std::string{"rate 1/s crash any component"};
  auto alone = schedule_of(line, 5).timed();
  auto together = schedule_of("every 1s kill any node\n" + line, 5).timed();
  std::erase_if(together, [](auto& x) { return x.statement == 0; });
  EXPECT_EQ(texts_of(alone), texts_of(together));
  auto twice = schedule_of(line + "\n" + line, 5).timed();
  EXPECT_NE(texts_of(twice), [&] {
    auto result = alone;
    result.insert(result.end(), alone.begin(), alone.end());
    std::ranges::stable_sort(result, {}, &DueFault::at);
    return texts_of(result);
  }());
}

/// The faults that happen because of a change.
std::vector<DueFault> faults_after(const FaultPlan& plan, FaultSchedule& schedule,
                                   const ChangeEvent& event, const Value& content, Timestamp now) {
  std::vector<DueFault> result;
  auto filters = watched_by(plan);
  for (std::size_t i = 0; i < filters.size(); ++i)
    if (matches(filters[i], event, content))
      if (auto x = schedule.on_change(i, now))
        result.push_back(*std::move(x));
  return result;
}

TEST(FaultSchedule, FaultsComeAfterChanges) {
  auto plan = plan_of("after 2 added in vision: crash tracker\n"
                      "at 1s crash tracker\n"
                      "after every 2 ScheduleTestBall where size > 1: crash segmentor\n");
  FaultSchedule schedule{plan, table_top(), 1, 10s};
  auto after = [&](const ChangeEvent& event, const Value& content, Timestamp now) {
    return faults_after(plan, schedule, event, content, now);
  };
  auto big = Value::of(ScheduleTestBall{2});
  auto small = Value::of(ScheduleTestBall{0.5});
  EXPECT_THAT(after(added_ball("vision"), small, 1s), testing::IsEmpty());
  EXPECT_THAT(texts_of(after(added_ball("vision"), big, 2s)),
              testing::ElementsAre("2s crash tracker"));
  EXPECT_THAT(texts_of(after(added_ball("binding"), big, 3s)),
              testing::ElementsAre("3s crash segmentor"));
  EXPECT_THAT(after(added_ball("vision"), big, 4s), testing::IsEmpty());
  EXPECT_THAT(texts_of(after(added_ball("vision"), big, 5s)),
              testing::ElementsAre("5s crash segmentor"));
}

TEST(FaultSchedule, ThePlanThatItComesToHasNothingLeftToDraw) {
  auto plan = schedule_of("every 5s crash any component or kill any node\n"
                          "after added in vision: crash any component of vision or kill any node\n")
                .as_plan();
  ASSERT_EQ(plan.statements.size(), 2U);
  for (auto& statement : plan.statements) {
    ASSERT_EQ(statement.faults.size(), 1U);
    EXPECT_EQ(to_string(statement).find("any"), std::string::npos) << to_string(statement);
  }
  EXPECT_EQ(to_string(plan.statements[1].where), "test.plan:2");
}

TEST(FaultSchedule, NothingToDrawFromIsRefused) {
  EXPECT_THROW((FaultSchedule{plan_of("at 1s kill any node"), test::small_system(), 1, 10s}),
               std::invalid_argument);
  EXPECT_THROW(schedule_of("every 1ms crash tracker", 1, 2000s), std::length_error);
}

bool names_what_cannot_be_drawn(const Statement& x) {
  SeededRandom random{1};
  try {
    for (auto& fault : x.faults)
      draw_targets(fault, table_top(), random);
    return false;
  } catch (const std::invalid_argument&) {
    return true;
  }
}

RC_GTEST_PROP(FaultSchedule, IsTheSameFromThePlanThatItComesTo, (std::uint64_t seed)) {
  auto plan = *test::any_plan();
  std::erase_if(plan.statements, names_what_cannot_be_drawn);
  FaultSchedule schedule{plan, table_top(), seed, 1s};
  auto resolved = plan_of(to_string(schedule.as_plan()));
  FaultSchedule again{resolved, table_top(), seed, 1s};
  RC_ASSERT(texts_of(schedule.timed()) == texts_of(again.timed()));
  for (auto i = 0; i < 5; ++i) {
    auto ball = Value::of(ScheduleTestBall{});
    RC_ASSERT(texts_of(faults_after(plan, schedule, added_ball("vision"), ball, 1s)) ==
              texts_of(faults_after(resolved, again, added_ball("vision"), ball, 1s)));
  }
}

} // namespace

} // namespace castor::faults
