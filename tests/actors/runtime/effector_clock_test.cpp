#include "castor/actors/runtime/effector_clock.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <vector>

namespace castor::test {

namespace {

using namespace std::chrono_literals;

EffectorClock::Time local(std::chrono::microseconds x) {
  return EffectorClock::Time{} + 1h + x;
}

TEST(EffectorClockTest, GoesOnFromTheLastReply) {
  EffectorClock clock;
  clock.synchronise(5s, local(0ms));
  EXPECT_EQ(clock.at(local(0ms)), 5s);
  EXPECT_EQ(clock.at(local(300ms)), 5300ms);
}

TEST(EffectorClockTest, PrefersTheQuickerReply) {
  EffectorClock clock;
  clock.synchronise(5s, local(0ms));      // as if it took 40 ms
  clock.synchronise(5050ms, local(10ms)); // at once
  EXPECT_EQ(clock.at(local(20ms)), 5060ms);
  clock.synchronise(5060ms, local(90ms)); // 70 ms late
  EXPECT_EQ(clock.at(local(100ms)), 5140ms);
}

TEST(EffectorClockTest, ForgetsReadingsOfLongAgo) {
  EffectorClock clock;
  clock.synchronise(5s, local(0ms));
  // It was set back, or runs more slowly.
  clock.synchronise(7900ms, local(3s));
  EXPECT_EQ(clock.at(local(3s)), 7900ms);
}

RC_GTEST_PROP(EffectorClockTest, IsNeverAheadAndBehindByTheBestReplyAtMost, ()) {
  constexpr std::chrono::microseconds offset = 77s;
  EffectorClock clock;
  std::chrono::microseconds now{0};
  auto replies = *rc::gen::nonEmpty<std::vector<std::pair<std::uint8_t, std::uint8_t>>>();
  auto best = std::chrono::microseconds::max();
  for (auto [wait, delay] : replies) {
    // All within the time that readings are remembered for.
    now += std::chrono::microseconds{wait} * 10 + std::chrono::microseconds{delay};
    if (now > 2s)
      break;
    clock.synchronise(offset + now - std::chrono::microseconds{delay}, local(now));
    best = std::min(best, std::chrono::microseconds{delay});
    RC_ASSERT(clock.at(local(now)) == offset + now - best);
  }
}

} // namespace

} // namespace castor::test
