#include "castor/actors/supervision/transition.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace castor::test {

namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;
using testing::IsEmpty;
using Step = Transition::Step;

Transition transition(std::vector<std::string> stop, std::vector<std::string> start) {
  return {1, {.stop = std::move(stop), .start = std::move(start), .remakes = true}, {}};
}

bool nobody(const std::string&) {
  return false;
}

TEST(Transition, StopsInTheReverseOrderOfTheStart) {
  EXPECT_THAT(transition({"a", "b"}, {"a", "b"}).stop(), ElementsAre("b", "a"));
}

TEST(Transition, EveryTurnHasANumber) {
  auto x = transition({"a", "b"}, {"a"});
  Transition::TimePoint now{3s};
  EXPECT_EQ(*x.current(), "b");
  auto turn = x.turn();
  x.next(now);
  EXPECT_EQ(*x.current(), "a");
  EXPECT_NE(x.turn(), turn);
  EXPECT_EQ(x.since(), now);
  x.next(now);
  EXPECT_EQ(x.current(), nullptr);
  x.enter(Step::wait, now);
  x.enter(Step::make, now);
  x.enter_configure(now, nobody);
  EXPECT_EQ(*x.current(), "a");
}

TEST(Transition, IncludesAndOverlapsOthers) {
  auto x = transition({"a", "b"}, {"a"});
  EXPECT_TRUE(x.includes(transition({}, {"b"})));
  EXPECT_FALSE(x.includes(transition({"a"}, {"c"})));
  EXPECT_TRUE(x.overlaps(transition({"a"}, {"c"})));
  EXPECT_FALSE(x.overlaps(transition({"c"}, {"c"})));
}

TEST(Transition, ConfiguresSomeLast) {
  auto x = transition({}, {"a", "b", "c"});
  x.enter_configure({}, [](auto& name) { return name == "a"; });
  std::vector<std::string> order;
  for (; x.current(); x.next({}))
    order.push_back(*x.current());
  EXPECT_THAT(order, ElementsAre("b", "c", "a"));
  x.enter(Step::start, {});
  EXPECT_EQ(*x.current(), "a");
}

TEST(Transition, WhatIsWithdrawnWhileItIsMadeIsNotConfigured) {
  auto x = transition({"a", "b"}, {"a", "b"});
  x.enter(Step::make, {});
  x.withdraw({"a"});
  EXPECT_THAT(x.start(), ElementsAre("a", "b"));
  x.enter_configure({}, nobody);
  EXPECT_THAT(x.start(), ElementsAre("b"));
}

TEST(Transition, WithdrawalsBeforeTheCurrentChildDoNotSkipAnybody) {
  auto x = transition({}, {"a", "b", "c"});
  x.enter_configure({}, nobody);
  x.next({});
  x.set_commanded();
  auto turn = x.turn();
  x.withdraw({"a"});
  EXPECT_EQ(*x.current(), "b");
  EXPECT_TRUE(x.is_commanded());
  EXPECT_EQ(x.turn(), turn);
  x.withdraw({"b"});
  EXPECT_EQ(*x.current(), "c");
  EXPECT_FALSE(x.is_commanded());
  EXPECT_NE(x.turn(), turn);
}

TEST(Transition, WhatWasStoppedForItIsFreeOnceSomethingIsWithdrawn) {
  auto x = transition({"a", "b"}, {"b"});
  x.withdraw({"b"});
  EXPECT_THAT(x.stop(), ElementsAre("b", "a"));
  EXPECT_THAT(x.start(), IsEmpty());
  x.enter(Step::wait, {});
  x.withdraw({"b"});
  EXPECT_FALSE(x.involves("a"));
}

} // namespace

} // namespace castor::test
