#include "castor/base/repeated_messages.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <optional>
#include <string>

namespace castor {

namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::IsEmpty;

class RepeatedMessagesTest : public testing::Test {
protected:
  RepeatedMessages::Time now{1h};
  RepeatedMessages messages{{.period = 10s, .written = 2, .kinds = 3, .length = 20}};
};

TEST_F(RepeatedMessagesTest, OfAKindAFewAreWrittenAndTheOthersCounted) {
  EXPECT_EQ(messages.add("port 1: bad", now), "port 1: bad");
  EXPECT_EQ(messages.add("port 2: bad", now), "port 2: bad");
  for (int i = 3; i <= 1000; ++i)
    EXPECT_EQ(messages.add("port " + std::to_string(i) + ": bad", now), std::nullopt);
  EXPECT_EQ(messages.add("port 5: worse", now), "port 5: worse");
  EXPECT_THAT(messages.take_due(now + 9s), IsEmpty());
  EXPECT_THAT(messages.take_due(now + 10s),
              ElementsAre("998 more like it in 10 s, the last: port 1000: bad"));
}

TEST_F(RepeatedMessagesTest, WhoGoesOnGetsOneLineInEachPeriod) {
  for (int second = 0; second < 30; ++second) {
    auto lines = messages.take_due(now).size();
    for (int i = 0; i < 100; ++i)
      lines += messages.add("flood", now) ? 1 : 0;
    EXPECT_EQ(lines, second == 0 ? 2u : second % 10 == 0 ? 1u : 0u) << second;
    now += 1s;
  }
}

TEST_F(RepeatedMessagesTest, AfterAQuietPeriodItBeginsAnew) {
  for (int i = 0; i < 3; ++i)
    messages.add("x", now);
  EXPECT_THAT(messages.take_due(now + 10s), ElementsAre("1 more like it in 10 s, the last: x"));
  EXPECT_THAT(messages.take_due(now + 20s), IsEmpty());
  EXPECT_EQ(messages.add("x", now + 20s), "x");
}

TEST_F(RepeatedMessagesTest, ManyKindsAreOneKind) {
  int written = 0;
  for (char c = 'a'; c <= 'z'; ++c)
    written += messages.add(std::string(3, c), now) ? 1 : 0;
  EXPECT_EQ(written, 3 + 2);
  EXPECT_THAT(messages.take_all(), ElementsAre("21 more like it in 10 s, the last: zzz"));
}

TEST_F(RepeatedMessagesTest, LongOnesAreCut) {
  EXPECT_EQ(messages.add(std::string(1000, 'x'), now), std::string(20, 'x') + " ...");
}

} // namespace

} // namespace castor
