#include "castor/actors/runtime/life_cycle.hpp"

#include <gtest/gtest.h>

namespace castor {

namespace {

TEST(LifeCycleState, PhasesAreEnteredInTheOrderInWhichTheyWereCommanded) {
  LifeCycle life;
  EXPECT_FALSE(life.try_enter(Phase::configure));
  life.command(Phase::configure);
  life.command(Phase::start);
  EXPECT_FALSE(life.try_enter(Phase::start));
  EXPECT_TRUE(life.try_enter(Phase::configure));
  EXPECT_FALSE(life.try_enter(Phase::configure));
  EXPECT_TRUE(life.try_enter(Phase::start));
  EXPECT_FALSE(life.try_enter(Phase::run));
  life.command(Phase::run);
  EXPECT_TRUE(life.try_enter(Phase::run));
}

TEST(LifeCycleState, ConfiguringLastsUntilItIsLeft) {
  LifeCycle life;
  life.command(Phase::configure);
  EXPECT_FALSE(life.is_configuring());
  life.try_enter(Phase::configure);
  EXPECT_TRUE(life.is_configuring());
  EXPECT_FALSE(life.has_started());
  life.leave_configure();
  EXPECT_FALSE(life.is_configuring());
}

TEST(LifeCycleState, WhatHasStartedStaysStartedInTheNextPhase) {
  LifeCycle life;
  for (auto phase : {Phase::configure, Phase::start, Phase::run})
    life.command(phase);
  life.try_enter(Phase::configure);
  life.leave_configure();
  life.try_enter(Phase::start);
  EXPECT_TRUE(life.has_started());
  life.try_enter(Phase::run);
  EXPECT_TRUE(life.has_started());
  EXPECT_FALSE(life.is_configuring());
}

TEST(LifeCycleState, OperationsAreRefusedAfterAStopButNotInTheStopHook) {
  LifeCycle life;
  EXPECT_FALSE(life.refuses_operations());
  life.stop();
  EXPECT_TRUE(life.is_stopping());
  EXPECT_TRUE(life.refuses_operations());
  life.enter_stop_hook();
  EXPECT_TRUE(life.is_stopping());
  EXPECT_FALSE(life.refuses_operations());
}

} // namespace

} // namespace castor
