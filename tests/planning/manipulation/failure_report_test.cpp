#include "castor/planning/manipulation/failure_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace castor::manipulation {

TEST(FailureReport, SaysWhatIsInTheWayAndAsWhatItIsSeen) {
  const std::vector<SeenThing> things{
    {"o1", "red", "cube", {"the red cube", box(0.05, 0.05, 0.05), {}}},
    {"o2", "blue", "sphere", {"the blue sphere", sphere(0.04), {}}}};
  Manipulation told;
  told.in_way_ids = {"of an earlier failure"};
  const std::vector<std::string> both{"the blue sphere", "the table"};
  tell_failure(told, {MotionFailureKind::no_way, both, "the blue sphere is in the way"}, things);
  EXPECT_EQ(told.reason, "the blue sphere is in the way");
  EXPECT_EQ(told.in_way, both);
  EXPECT_THAT(told.in_way_ids, testing::ElementsAre("o2", ""));
}

TEST(FailureReport, NamesTheJointsThatDoNotMove) {
  Manipulation told;
  told.still_joints = {"lift"};
  tell_failure(told, {MotionFailureKind::out_of_reach, {}, "the ball is out of reach"}, {});
  EXPECT_EQ(told.reason, "the ball is out of reach; its joint lift does not move any more");
  EXPECT_TRUE(told.in_way_ids.empty());
}

} // namespace castor::manipulation
