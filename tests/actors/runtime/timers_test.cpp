#include "castor/actors/runtime/timers.hpp"

#include <gtest/gtest.h>

#include <string>

namespace castor {

namespace {

using namespace std::chrono_literals;

class TimersTest : public testing::Test {
protected:
  TimerId add(std::chrono::nanoseconds period, char name) {
    return timers.add(period, now, [this, name] { log += name; });
  }

  std::string run_after(std::chrono::nanoseconds x) {
    now += x;
    log.clear();
    for (auto& [id, call] : timers.take_due(now))
      (*call)();
    return log;
  }

  Timers timers;
  Timers::TimePoint now{1h};
  std::string log;
};

TEST_F(TimersTest, CallsAreDueAtMultiplesOfThePeriodHoweverLateTheEarlierOnesWere) {
  add(10ms, 'a');
  EXPECT_EQ(run_after(9ms), "");
  EXPECT_EQ(run_after(4ms), "a");
  EXPECT_EQ(timers.next(), Timers::TimePoint{1h} + 20ms);
  EXPECT_EQ(run_after(7ms), "a");
}

TEST_F(TimersTest, MissedCallsAreLeftOut) {
  add(10ms, 'a');
  EXPECT_EQ(run_after(35ms), "a");
  EXPECT_EQ(timers.next(), Timers::TimePoint{1h} + 40ms);
}

TEST_F(TimersTest, CallsComeInTheOrderOfTheirTimes) {
  add(10ms, 'a');
  add(4ms, 'b');
  EXPECT_EQ(run_after(10ms), "ba");
}

TEST_F(TimersTest, ARemovedTimerIsNotDue) {
  auto a = add(10ms, 'a');
  timers.remove(a);
  EXPECT_FALSE(timers.contains(a));
  EXPECT_EQ(timers.next(), Timers::TimePoint::max());
  EXPECT_EQ(run_after(1s), "");
}

} // namespace

} // namespace castor
