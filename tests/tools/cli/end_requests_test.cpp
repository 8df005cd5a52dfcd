#include "castor/tools/cli/end_requests.hpp"

#include <gtest/gtest.h>

namespace castor::cli {

namespace {

using namespace std::chrono_literals;
using Kind = EndRequests::Kind;
using Answer = EndRequests::Answer;

/// Some moment.
constexpr EndRequests::Clock::time_point begin{100s};

TEST(EndRequests, TheFirstEndsTheProcessInOrderAndTheSecondByForce) {
  EndRequests x;
  EXPECT_EQ(x.look(begin + 1h), Answer::nothing);
  EXPECT_EQ(x.request(Kind::interrupt, begin), Answer::in_order);
  EXPECT_EQ(x.look(begin + 1h), Answer::nothing);
  EXPECT_EQ(x.request(Kind::interrupt, begin + 1h), Answer::by_force);
}

TEST(EndRequests, TheSameSignalToTheProcessAndItsGroupIsOneRequest) {
  EndRequests x;
  EXPECT_EQ(x.request(Kind::interrupt, begin), Answer::in_order);
  EXPECT_EQ(x.request(Kind::interrupt, begin + 1ms), Answer::nothing);
  EXPECT_EQ(x.request(Kind::interrupt, begin + EndRequests::same_request), Answer::by_force);
}

TEST(EndRequests, OnlyAUserInsists) {
  for (auto first : {Kind::interrupt, Kind::hangup, Kind::output_ended, Kind::input_ended}) {
    EndRequests x;
    EXPECT_EQ(x.request(first, begin), Answer::in_order);
    for (auto second : {Kind::hangup, Kind::output_ended, Kind::input_ended})
      EXPECT_EQ(x.request(second, begin + 1s), Answer::nothing);
    EXPECT_EQ(x.request(Kind::interrupt, begin + 2s), Answer::by_force);
  }
}

TEST(EndRequests, WithPatienceTheFirstIsEnoughAfterAWhile) {
  EndRequests x{5s};
  EXPECT_FALSE(x.deadline());
  EXPECT_EQ(x.request(Kind::input_ended, begin), Answer::in_order);
  EXPECT_EQ(x.deadline(), begin + 5s);
  EXPECT_EQ(x.look(begin + 5s - 1ns), Answer::nothing);
  EXPECT_EQ(x.look(begin + 5s), Answer::by_force);
}

TEST(EndRequests, ALimitHoldsWithoutARequestUntilItIsLifted) {
  EndRequests x{5s};
  x.set_limit(begin + 3s);
  EXPECT_EQ(x.deadline(), begin + 3s);
  EXPECT_EQ(x.look(begin + 3s), Answer::by_force);
  x.set_limit({});
  EXPECT_EQ(x.look(begin + 1h), Answer::nothing);
  x.request(Kind::interrupt, begin);
  x.set_limit(begin + 10s);
  EXPECT_EQ(x.deadline(), begin + 5s);
}

} // namespace

} // namespace castor::cli
