#include "castor/wm/clock/time_control.hpp"

#include <gtest/gtest.h>

#include <optional>

namespace castor {

namespace {

using namespace std::chrono_literals;

class TimeControlTest : public testing::Test {
protected:
  using RealTime = TimeControl::RealTime;

  /// A report of the own process for the present round.
  void own_report(Timestamp next) { report(0, next); }

  void report(ClockMember from, Timestamp next, MessageCounts counts = {}) {
    control.report(from, {control.present().round, next, std::move(counts)});
  }

  /// Time after the decision; nothing if it stands.
  std::optional<Timestamp> advanced() {
    auto x = control.decide(real).advance;
    return x ? std::optional{x->time} : std::nullopt;
  }

  RealTime real{1h};
  TimeControl control{real};
};

TEST_F(TimeControlTest, TimeGoesOnToTheNextSleeperOnceTheProcessIsQuiet) {
  EXPECT_EQ(advanced(), std::nullopt);
  own_report(3s);
  EXPECT_EQ(advanced(), Timestamp{3s});
  EXPECT_EQ(control.now(), Timestamp{3s});
  // Whoever was woken has something to do now.
  EXPECT_EQ(advanced(), std::nullopt);
  own_report(4s);
  EXPECT_EQ(advanced(), Timestamp{4s});
}

TEST_F(TimeControlTest, TimeStandsIfNobodySleeps) {
  own_report(Timestamp::max());
  EXPECT_EQ(advanced(), std::nullopt);
  EXPECT_FALSE(control.decide(real).at_limit);
}

TEST_F(TimeControlTest, TimeGoesOnUpToTheLimit) {
  control.set_limit(2s);
  own_report(3s);
  EXPECT_EQ(advanced(), Timestamp{2s});
  own_report(3s);
  auto decision = control.decide(real);
  EXPECT_FALSE(decision.advance);
  EXPECT_TRUE(decision.at_limit);
  control.set_limit(5s);
  EXPECT_EQ(advanced(), Timestamp{3s});
}

TEST_F(TimeControlTest, TimeGoesOnToTheLimitIfNobodySleeps) {
  control.set_limit(2s);
  own_report(Timestamp::max());
  EXPECT_EQ(advanced(), Timestamp{2s});
}

TEST_F(TimeControlTest, WhoIsDueIsWokenAtTheLimitToo) {
  control.set_limit(0s);
  own_report(0s);
  EXPECT_EQ(advanced(), Timestamp{0s});
  own_report(1s);
  EXPECT_EQ(advanced(), std::nullopt);
}

TEST_F(TimeControlTest, AReportOfAnEarlierRoundDoesNotCount) {
  own_report(1s);
  ASSERT_EQ(advanced(), Timestamp{1s});
  control.report(0, {0, 2s, {}});
  EXPECT_EQ(advanced(), std::nullopt);
  EXPECT_EQ(control.busy(), std::vector<ClockMember>{0});
}

TEST_F(TimeControlTest, TimeStandsUntilEveryProcessHasReported) {
  control.add_member(1);
  own_report(5s);
  EXPECT_EQ(advanced(), std::nullopt);
  report(1, 4s);
  EXPECT_EQ(advanced(), Timestamp{4s});
}

TEST_F(TimeControlTest, OnlyThoseWhoHaveSomebodyToWakeAreTold) {
  control.add_member(1);
  control.add_member(2);
  own_report(5s);
  report(1, 4s);
  report(2, 9s);
  auto decision = control.decide(real);
  ASSERT_TRUE(decision.advance);
  EXPECT_EQ(decision.receivers, std::vector<ClockMember>{1});
  own_report(5s);
  EXPECT_EQ(advanced(), std::nullopt);
  report(1, 8s);
  EXPECT_EQ(advanced(), Timestamp{5s});
}

TEST_F(TimeControlTest, TimeStandsWhileAMessageIsBetweenTwoProcesses) {
  control.add_member(1);
  control.add_member(2);
  report(0, 5s, {{{1, 1}}, {}});
  report(1, 5s, {{}, {{2, 1}}});
  report(2, 5s);
  // The sums are equal: what 1 has received comes from 2, whose report is older than that.
  EXPECT_EQ(advanced(), std::nullopt);
  report(2, 5s, {{{1, 1}}, {}});
  EXPECT_EQ(advanced(), std::nullopt);
  report(1, 5s, {{}, {{0, 1}, {2, 1}}});
  EXPECT_EQ(advanced(), Timestamp{5s});
}

TEST_F(TimeControlTest, ALostProcessIsNotWaitedForNorItsMessages) {
  control.add_member(1);
  report(0, 5s, {{{1, 3}}, {{1, 2}}});
  EXPECT_EQ(advanced(), std::nullopt);
  control.remove_member(1);
  EXPECT_EQ(advanced(), Timestamp{5s});
}

TEST_F(TimeControlTest, AFactorIsKept) {
  control.set_pace({10, false}, real);
  own_report(5s);
  auto decision = control.decide(real);
  EXPECT_FALSE(decision.advance);
  ASSERT_TRUE(decision.ask_again);
  EXPECT_LE(*decision.ask_again, real + 500ms);
  real += 500ms;
  EXPECT_EQ(advanced(), Timestamp{5s});
}

TEST_F(TimeControlTest, AtAFactorTimeGoesOnThoughNobodyIsWoken) {
  control.set_pace({1, false}, real);
  own_report(5s);
  real += 100ms;
  EXPECT_EQ(advanced(), Timestamp{100ms});
  own_report(Timestamp::max());
  real += 100ms;
  EXPECT_EQ(advanced(), Timestamp{200ms});
}

TEST_F(TimeControlTest, WhatTookLongerThanItsTimeIsCaughtUpWith) {
  control.set_pace({1, false}, real);
  own_report(1s);
  real += 3s;
  EXPECT_EQ(advanced(), Timestamp{1s});
  own_report(2s);
  EXPECT_EQ(advanced(), Timestamp{2s});
}

TEST_F(TimeControlTest, PausedTimeGoesOnByStepsOnly) {
  control.set_pace({std::nullopt, true}, real);
  own_report(150ms);
  EXPECT_EQ(advanced(), std::nullopt);
  EXPECT_FALSE(control.decide(real).at_limit);
  control.step(100ms);
  EXPECT_EQ(advanced(), Timestamp{100ms});
  own_report(150ms);
  EXPECT_EQ(advanced(), std::nullopt);
  control.step(100ms);
  EXPECT_EQ(advanced(), Timestamp{150ms});
  own_report(300ms);
  EXPECT_EQ(advanced(), Timestamp{200ms});
  control.set_pace({}, real);
  own_report(300ms);
  EXPECT_EQ(advanced(), Timestamp{300ms});
}

TEST_F(TimeControlTest, AfterAPauseAFactorBeginsAnew) {
  control.set_pace({1, true}, real);
  own_report(100ms);
  real += 10s;
  control.set_pace({1, false}, real);
  EXPECT_EQ(advanced(), std::nullopt);
  real += 100ms;
  EXPECT_EQ(advanced(), Timestamp{100ms});
}

} // namespace

} // namespace castor
