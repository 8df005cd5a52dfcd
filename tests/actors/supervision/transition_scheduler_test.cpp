#include "castor/actors/supervision/transition_scheduler.hpp"

#include "castor/tests/actors/node/support.hpp"
#include "castor/tests/actors/supervision/simulated_children.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

namespace castor::test {

namespace {

using namespace std::chrono_literals;
using testing::Contains;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::Not;
using Names = std::vector<std::string>;

class TransitionSchedulerTest : public testing::Test {
protected:
  void start(const Names& names) {
    scheduler.begin({.start = names, .done = [this](auto& x) { started = x; }});
  }

  void stop(const Names& names) {
    scheduler.stop({.stop = names, .done = [this](auto& x) { stopped = x; }});
  }

  void restart(const Names& names, Timestamp delay = {}) {
    scheduler.begin({.stop = names,
                     .start = names,
                     .remakes = true,
                     .reason = "test",
                     .delay = delay,
                     .done = [this](auto&) { ++restarted; }});
  }

  SimulatedChildren children{architecture(subarchitecture("a", "localhost") +
                                          "CPP MG m M\nCPP UM u U\nCPP UM v U\n"
                                          "COMPONENT CPP camera C\n")};
  TransitionScheduler& scheduler = children.scheduler;
  std::vector<std::string>& log = children.log;
  std::optional<TransitionResult> started;
  std::optional<TransitionResult> stopped;
  int restarted = 0;
};

TEST_F(TransitionSchedulerTest, ConfiguresAllThenStartsAllThenLetsThemRun) {
  start({"camera", "a_wm", "u", "v"});
  children.work();
  // Those outside the subarchitectures are configured last.
  EXPECT_THAT(log, ElementsAre("configure u", "configure v", "configure camera", "start camera",
                               "camera is up", "start u", "u is up", "start v", "v is up",
                               "run camera", "run u", "run v", "a_wm is up"));
  EXPECT_TRUE(started);
}

TEST_F(TransitionSchedulerTest, StopsOneAfterTheOtherLastFirst) {
  stop({"m", "u", "v"});
  EXPECT_THAT(log, ElementsAre("stop v"));
  children.end("v", ComponentEnded::How::stopped);
  EXPECT_THAT(log, ElementsAre("stop v", "stop u"));
  children.work();
  ASSERT_TRUE(stopped);
  EXPECT_THAT(stopped->stopped, ElementsAre("v", "u", "m"));
  EXPECT_TRUE(children.model.child("m").given_up);
}

TEST_F(TransitionSchedulerTest, TransitionsThatShareAChildRunOneAfterTheOther) {
  restart({"m", "u"});
  restart({"u", "v"});
  restart({"camera"});
  EXPECT_EQ(scheduler.running().size(), 2u);
  EXPECT_EQ(scheduler.waiting().size(), 1u);
  children.work();
  EXPECT_EQ(restarted, 3);
  EXPECT_EQ(children.model.child("u").incarnation, 3u);
  EXPECT_EQ(children.model.child("v").incarnation, 2u);
}

TEST_F(TransitionSchedulerTest, ATransitionReplacesThoseThatItIncludes) {
  restart({"u"});
  restart({"u", "v"});
  EXPECT_EQ(restarted, 1);
  EXPECT_EQ(scheduler.running().size(), 1u);
  children.work();
  EXPECT_EQ(restarted, 2);
  EXPECT_EQ(children.model.child("u").incarnation, 2u);
}

TEST_F(TransitionSchedulerTest, OnlyWhatOthersKnowIsMadeByPlan) {
  restart({"m", "u"});
  restart({"camera"});
  children.work();
  EXPECT_THAT(log, testing::IsSupersetOf({"make m", "make u", "plan camera"}));
}

TEST_F(TransitionSchedulerTest, WaitsBeforeItMakesAnything) {
  restart({"u"}, 3s);
  children.work();
  children.let_time_pass(2900ms);
  EXPECT_THAT(log, Not(Contains("make u")));
  children.let_time_pass(100ms);
  EXPECT_THAT(log, Contains("make u"));
}

TEST_F(TransitionSchedulerTest, AChildThatDoesNotStopIsGivenUp) {
  restart({"u", "v"});
  children.let_time_pass(4900ms);
  EXPECT_THAT(log, testing::Each("stop v"));
  children.let_time_pass(200ms);
  EXPECT_THAT(log, Contains("v is stuck, and not started again"));
  children.end("u", ComponentEnded::How::stopped);
  children.work();
  EXPECT_TRUE(children.model.child("v").given_up);
  EXPECT_EQ(children.model.child("v").incarnation, 1u);
  EXPECT_EQ(children.model.child("u").incarnation, 2u);
}

TEST_F(TransitionSchedulerTest, AfterAnInterruptChildrenHaveASecondToStop) {
  children.interrupted = true;
  stop({"v"});
  children.let_time_pass(900ms);
  EXPECT_FALSE(stopped);
  children.let_time_pass(200ms);
  ASSERT_TRUE(stopped);
  EXPECT_THAT(stopped->stuck, ElementsAre("v"));
}

TEST_F(TransitionSchedulerTest, AChildThatDoesNotStopIsKilledOnceAndStartedAgainIfThatCanBe) {
  children.killable = {"v"};
  restart({"v"});
  children.let_time_pass(5100ms);
  EXPECT_THAT(log, Contains("kill v"));
  EXPECT_TRUE(children.model.child("v").killed);
  children.end("v", ComponentEnded::How::stopped);
  children.work();
  EXPECT_EQ(restarted, 1);
  EXPECT_EQ(children.model.child("v").incarnation, 2u);
}

TEST_F(TransitionSchedulerTest, ChildrenOutOfReachAreNotWaitedFor) {
  children.unreachable = {"v"};
  stop({"u", "v"});
  EXPECT_THAT(log, ElementsAre("stop u"));
}

TEST_F(TransitionSchedulerTest, AWrongConfigurationIsReportedAndNobodyIsStarted) {
  start({"u", "v"});
  children.phase_done("u", Phase::configure, "--size is\nmissing");
  children.end("u");
  children.phase_done("v", Phase::configure);
  ASSERT_TRUE(started);
  ASSERT_EQ(started->problems.size(), 1u);
  EXPECT_EQ(started->problems[0].message, "u cannot be configured: --size is; missing");
  EXPECT_EQ(started->problems[0].line, "CPP UM u U");
  EXPECT_THAT(log, Not(Contains(testing::StartsWith("start "))));
  EXPECT_TRUE(children.model.child("v").given_up);
}

TEST_F(TransitionSchedulerTest, WhatFailsMeanwhileIsReportedAtTheEnd) {
  restart({"u", "v"});
  children.end("v", ComponentEnded::How::stopped);
  children.end("u", ComponentEnded::How::stopped);
  ASSERT_EQ(children.makings.size(), 1u);
  // It ends before it is known that it was made.
  EXPECT_TRUE(children.end("u"));
  children.work();
  EXPECT_EQ(log.back(), "u failed");
  EXPECT_FALSE(children.model.child("u").alive);
  EXPECT_TRUE(children.model.child("v").alive);
}

TEST_F(TransitionSchedulerTest, WhatCannotBeMadeHasFailed) {
  restart({"u", "v"});
  children.end("v", ComponentEnded::How::stopped);
  children.end("u", ComponentEnded::How::stopped);
  children.makings.back().done({"v"});
  children.makings.clear();
  children.work();
  EXPECT_EQ(log.back(), "v failed");
  EXPECT_EQ(restarted, 1);
}

TEST_F(TransitionSchedulerTest, APhaseCommandIsSentAgainOnlyToAnActorThatReplacesTheFormerOne) {
  start({"u"});
  scheduler.resume();
  EXPECT_THAT(log, ElementsAre("configure u"));
  children.replaced = {"u"};
  scheduler.resume();
  EXPECT_THAT(log, ElementsAre("configure u", "configure u"));
}

TEST_F(TransitionSchedulerTest, AChildWithoutActorIsWaitedFor) {
  children.without_actor = {"u"};
  start({"u"});
  EXPECT_THAT(log, IsEmpty());
  children.without_actor.clear();
  scheduler.resume();
  EXPECT_THAT(log, ElementsAre("configure u"));
}

TEST_F(TransitionSchedulerTest, SlowChildrenAreReportedAgainAndAgain) {
  start({"u"});
  children.let_time_pass(11s);
  EXPECT_THAT(log, ElementsAre("configure u", "u is slow", "u is slow"));
}

TEST_F(TransitionSchedulerTest, WhatIsStoppedIsNotStartedByOthersAnyMore) {
  restart({"u", "v"});
  // Also where nothing is left to be started.
  scheduler.begin({.stop = {"camera", "m"}, .start = {"m"}, .remakes = true, .done = [this](auto&) {
                     ++restarted;
                   }});
  stop({"m", "v"});
  children.work();
  EXPECT_EQ(restarted, 2);
  EXPECT_TRUE(stopped);
  EXPECT_THAT(log, Contains("run u"));
  EXPECT_THAT(log, Not(Contains("make v")));
  EXPECT_THAT(log, Not(Contains("make m")));
  EXPECT_THAT(scheduler.running(), IsEmpty());
}

TEST_F(TransitionSchedulerTest, TheTimeThatATransitionWaitsIsNotTimeToStop) {
  restart({"m", "u"});
  stop({"u", "v"});
  children.end("u", ComponentEnded::How::stopped);
  children.let_time_pass(1s);
  ASSERT_EQ(scheduler.waiting().size(), 1u);
  children.let_time_pass(5s);
  // The first one gives up m.
  ASSERT_EQ(scheduler.waiting().size(), 0u);
  EXPECT_THAT(log, Not(Contains("v is stuck")));
}

TEST_F(TransitionSchedulerTest, ChildrenWhoseProcessIsLostMeanwhileAreLeftToOthers) {
  restart({"u", "v"});
  children.end("v", ComponentEnded::How::stopped);
  children.end("u", ComponentEnded::How::stopped);
  scheduler.lose({"u"});
  children.work();
  EXPECT_FALSE(children.model.child("u").alive);
  EXPECT_THAT(log, Not(Contains("u failed")));
  EXPECT_THAT(log, Contains("run v"));
}

} // namespace

} // namespace castor::test
