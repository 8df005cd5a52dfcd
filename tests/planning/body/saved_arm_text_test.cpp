#include "castor/planning/body/saved_arm_text.hpp"

#include "castor/mapping/geometry/poses.hpp"
#include "castor/planning/manipulation/kinematics.hpp"
#include "castor/tests/planning/body/arm_at_table.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

namespace castor::manipulation {

namespace {

/// A cube in the gripper, and one on the table.
ArmBody body_with_cube() {
  const auto arm = katana();
  const auto tool = tool_pose(arm, arm.home);
  auto table =
    table_with({{"the green cube 2", box(0.05, 0.05, 0.05), {{0.1, 0.3, 0.1}, {}, arm_frame}}});
  table.add({"the red cube", box(0.04, 0.04, 0.04), tool});
  return {arm, table, aside()};
}

SavedArm holding(const ArmBody& body) {
  auto result = body.saved();
  result.positions[0] += 0.123456789;
  result.opening = 0.041;
  result.collisions = 2;
  result.missed = 3;
  result.dropped = 1;
  result.moved = 1.5;
  result.things[1].support = "the gripper";
  result.things[1].thing.pose = tool_pose(body.arm(), result.positions);
  return result;
}

TEST(SavedArmText, LosesNothing) {
  const auto before = holding(body_with_cube());
  const auto read = parse_saved_arm(saved_arm_text({12'345'678, before}));
  ASSERT_TRUE(read);
  EXPECT_EQ(read->time, 12'345'678);
  const auto& after = read->state;
  EXPECT_EQ(after.positions, before.positions);
  EXPECT_EQ(after.opening, before.opening);
  EXPECT_EQ(after.changes, before.changes);
  EXPECT_EQ(after.collisions, 2);
  EXPECT_EQ(after.missed, 3);
  EXPECT_EQ(after.dropped, 1);
  EXPECT_EQ(after.moved, 1.5);
  ASSERT_EQ(after.things.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(after.things[i].thing.name, before.things[i].thing.name);
    EXPECT_EQ(after.things[i].thing.pose.position, before.things[i].thing.pose.position);
    EXPECT_EQ(after.things[i].thing.pose.rotation, before.things[i].thing.pose.rotation);
    EXPECT_EQ(after.things[i].support, before.things[i].support);
  }
}

TEST(SavedArmText, OtherTextIsNoState) {
  const auto text = saved_arm_text({1, body_with_cube().saved()});
  EXPECT_FALSE(parse_saved_arm(""));
  EXPECT_FALSE(parse_saved_arm("arm 1 2\njoints 1\n"));
  EXPECT_FALSE(parse_saved_arm(text.substr(0, text.rfind("on "))));
  EXPECT_FALSE(parse_saved_arm("joints 0\n" + text));
}

TEST(ArmBody, GoesOnWithWhatItHeld) {
  auto body = body_with_cube();
  const auto before = holding(body);
  body.resume(before);
  EXPECT_EQ(body.configuration(), before.positions);
  EXPECT_EQ(body.opening(), 0.041);
  EXPECT_TRUE(body.state().holds);
  EXPECT_TRUE(body.state().rests);
  EXPECT_GT(body.changes(), before.changes) << "cameras would show the picture of before";
  EXPECT_EQ(body.status().collisions, 2);
  // It carries it on.
  auto to = before.positions;
  to[0] += 0.5;
  ASSERT_TRUE(carry_out(body, motion(body.arm(), before.positions, to, 0), 1));
  const auto tool = tool_pose(body.arm(), body.configuration());
  EXPECT_LT(
    geometry::distance(body.world().thing("the red cube").thing.pose.position, tool.position),
    1e-6);
}

TEST(ArmBody, RefusesTheStateOfAnotherTable) {
  auto body = body_with_cube();
  auto other = holding(body);
  other.things.pop_back();
  EXPECT_THROW(body.resume(other), std::invalid_argument);
  other = holding(body);
  other.positions.pop_back();
  EXPECT_THROW(body.resume(other), std::invalid_argument);
}

} // namespace

} // namespace castor::manipulation
