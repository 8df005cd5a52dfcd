#include "castor/planning/body/arm_evaluation.hpp"

#include <gtest/gtest.h>

#include <string>

namespace castor::manipulation {

namespace {

ArmStatus status(const std::string& support, double height, double moved) {
  ArmStatus result;
  result.things = {{"the ball", {{0.1, 0, height}, {}, "table"}, support},
                   {"the cube", {{0, 0, 0.02}, {}, "table"}, "the table"}};
  result.moved = moved;
  return result;
}

} // namespace

TEST(ArmEvaluation, CountsWhatIsTakenAndPutDown) {
  ArmEvaluation x;
  evaluate(x, status("the table", 0.03, 0));
  evaluate(x, status("the gripper", 0.03, 0));
  evaluate(x, status("the gripper", 0.2, 1));
  EXPECT_EQ(x.held, "the ball");
  evaluate(x, status("the gripper", 0.035, 2));
  evaluate(x, status("the table", 0.03, 2));
  EXPECT_EQ(x.taken, 1);
  EXPECT_EQ(x.put_down, 1);
  EXPECT_EQ(x.dropped, 0);
  EXPECT_EQ(x.held, "");
}

TEST(ArmEvaluation, WhatFallsOutOfTheGripperIsDropped) {
  ArmEvaluation x;
  evaluate(x, status("the gripper", 0.2, 1));
  evaluate(x, status("the table", 0.03, 1.05));
  EXPECT_EQ(x.dropped, 1);
  EXPECT_EQ(x.drop, "the ball fell by 0.17 m");
  evaluate(x, status("the floor", -0.7, 1.05));
  EXPECT_EQ(x.fallen, 1);
}

TEST(ArmEvaluation, WhatWasPutDownUnseenOrByAnInjectedFaultIsNotDropped) {
  ArmEvaluation x;
  evaluate(x, status("the gripper", 0.2, 1));
  evaluate(x, status("the table", 0.03, 4));
  EXPECT_EQ(x.dropped, 0);
  evaluate(x, status("the gripper", 0.2, 5));
  auto lost = status("the table", 0.03, 5);
  lost.dropped = 1;
  evaluate(x, lost);
  EXPECT_EQ(x.dropped, 0);
}

TEST(ArmEvaluation, KeepsTheLongestTimeWithoutCommands) {
  ArmEvaluation x;
  auto late = status("the table", 0.03, 0);
  late.uncommanded = 0.7;
  evaluate(x, late);
  evaluate(x, status("the table", 0.03, 0));
  EXPECT_EQ(x.uncommanded, 0.7);
}

} // namespace castor::manipulation
