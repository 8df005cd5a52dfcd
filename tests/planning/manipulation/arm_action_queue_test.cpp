#include "castor/planning/manipulation/arm_action_queue.hpp"

#include <gtest/gtest.h>

namespace castor::manipulation {

namespace {

const Address first{"asking", "1"};
const Address second{"asking", "2"};

} // namespace

TEST(ArmActionQueue, AStopEndsTheOneThatRunsAndThoseThatWait) {
  ArmActionQueue queue;
  queue.arrive(first);
  queue.arrive(second);
  EXPECT_TRUE(queue.begin(first));
  EXPECT_FALSE(queue.is_stopped());
  queue.stop();
  EXPECT_TRUE(queue.is_stopped());
  EXPECT_FALSE(queue.begin(second));
}

TEST(ArmActionQueue, ActionsAfterAStopBegin) {
  ArmActionQueue queue;
  queue.stop();
  queue.arrive(first);
  EXPECT_TRUE(queue.begin(first));
  EXPECT_FALSE(queue.is_stopped());
}

TEST(ArmActionQueue, AnActionMayBeginBeforeItsArrivalIsTold) {
  ArmActionQueue queue;
  EXPECT_TRUE(queue.begin(first));
  queue.arrive(first);
  queue.stop();
  EXPECT_TRUE(queue.is_stopped());
  queue.arrive(second);
  EXPECT_TRUE(queue.begin(second));
}

} // namespace castor::manipulation
