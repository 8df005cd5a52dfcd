#include "castor/planning/manipulation/table_world.hpp"

#include "castor/mapping/geometry/poses.hpp"
#include "castor/planning/manipulation/collision_checker.hpp"
#include "castor/tests/planning/manipulation/katana.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace castor::manipulation {

namespace {

const Gripper gripper;

/// The tool straight down, there.
Pose from_above(const Point3& at) {
  return {at, {0, 0, 1, 0}, arm_frame};
}

TableWorld table() {
  return TableWorld(table_top(1, 1));
}

NamedSolid cube_at(const std::string& name, double x, double y, double z) {
  return thing(name, box(0.04, 0.04, 0.04), x, y, z);
}

} // namespace

TEST(TableWorld, ThingsFallOntoTheTable) {
  auto world = table();
  world.add(thing("the ball", sphere(0.05), 0.2, 0.1, 0.5));
  EXPECT_EQ(world.thing("the ball").support, "the table");
  EXPECT_NEAR(world.thing("the ball").thing.pose.position.z, 0.025, 1e-5);
  EXPECT_EQ(world.thing("the ball").thing.pose.position.x, 0.2);
}

TEST(TableWorld, ThingsFallOverTheEdge) {
  auto world = table();
  world.add(cube_at("over", 0.51, 0, 0.1));
  world.add(cube_at("on", 0.49, 0.1, 0.1));
  EXPECT_EQ(world.thing("over").support, "the floor");
  EXPECT_EQ(world.thing("on").support, "the table");
  ASSERT_EQ(world.scene().things.size(), 2u);
  EXPECT_EQ(world.scene().things[1].name, "on");
}

TEST(TableWorld, ThingsStackOnFlatTops) {
  auto world = table();
  world.add(thing("the can", cylinder(0.06, 0.1), 0.2, 0, 0.3));
  world.add(cube_at("the cube", 0.21, 0, 0.3));
  EXPECT_EQ(world.thing("the cube").support, "the can");
  EXPECT_NEAR(world.thing("the cube").thing.pose.position.z, 0.12, 1e-5);
}

TEST(TableWorld, ThingsArePushedWithWhatStandsOnThem) {
  auto world = table();
  world.add(thing("the can", cylinder(0.06, 0.1), 0.2, 0, 0.05));
  world.add(cube_at("the cube", 0.2, 0, 0.3));
  EXPECT_TRUE(world.push("the can", 0.03, 0.01));
  EXPECT_NEAR(world.thing("the can").thing.pose.position.x, 0.23, 1e-9);
  EXPECT_NEAR(world.thing("the cube").thing.pose.position.y, 0.01, 1e-9);
  EXPECT_EQ(world.thing("the cube").support, "the can");
}

TEST(TableWorld, ThingsAreNotPushedIntoOthers) {
  auto world = table();
  world.add(cube_at("one", 0.2, 0, 0.02));
  world.add(cube_at("two", 0.25, 0, 0.02));
  EXPECT_FALSE(world.push("one", 0.02, 0));
  EXPECT_EQ(world.thing("one").thing.pose.position.x, 0.2);
  EXPECT_TRUE(world.push("one", -0.02, 0));
  EXPECT_THROW(world.push("three", 0, 0), std::invalid_argument);
}

TEST(TableWorld, ThingsArePushedOverTheEdge) {
  auto world = table();
  world.add(cube_at("one", 0.49, 0, 0.02));
  EXPECT_TRUE(world.push("one", 0.02, 0));
  EXPECT_EQ(world.thing("one").support, "the floor");
}

TEST(TableWorld, WhatIsHeldIsNotPushed) {
  auto world = table();
  world.add(cube_at("one", 0.2, 0, 0.02));
  ASSERT_NE(world.between_fingers(gripper, from_above({0.2, 0, 0.02}), gripper.widest), nullptr);
  EXPECT_EQ(world.between_fingers(gripper, from_above({0.4, 0, 0.02}), gripper.widest), nullptr);
  world.close_gripper(gripper, from_above({0.2, 0, 0.02}), gripper.widest);
  EXPECT_FALSE(world.push("one", 0.02, 0));
}

TEST(TableWorld, NothingStaysOnABall) {
  auto world = table();
  world.add(thing("the ball", sphere(0.05), 0.2, 0, 0.3));
  world.add(cube_at("the cube", 0.2, 0.005, 0.3));
  EXPECT_EQ(world.thing("the cube").support, "the table");
  EXPECT_FALSE(overlap(world.thing("the cube").thing, world.thing("the ball").thing));
  EXPECT_GT(world.thing("the cube").thing.pose.position.y, 0.04);
}

TEST(TableWorld, WhatIsTiltedTurnsOntoItsNearestSide) {
  auto world = table();
  auto brick = thing("the brick", box(0.1, 0.04, 0.06), 0.2, 0, 0.3);
  // 60 degrees about y: nearly on its end.
  brick.pose.rotation = {std::cos(std::numbers::pi / 6), 0, std::sin(std::numbers::pi / 6), 0};
  world.add(brick);
  EXPECT_NEAR(world.thing("the brick").thing.pose.position.z, 0.05, 1e-5);
  auto can = thing("the can", cylinder(0.05, 0.1), -0.2, 0, 0.3);
  can.pose.rotation = brick.pose.rotation;
  world.add(can);
  EXPECT_NEAR(world.thing("the can").thing.pose.position.z, 0.025, 1e-5);
}

TEST(TableWorld, TheGripperCarriesAThingAndWhatStandsOnIt) {
  auto world = table();
  world.add(cube_at("below", 0.2, 0, 0.1));
  world.add(cube_at("above", 0.2, 0.01, 0.1));
  ASSERT_EQ(world.close_gripper(gripper, from_above({0.2, 0, 0.02}), gripper.widest), "below");
  EXPECT_EQ(world.held()->thing.name, "below");
  world.move_tool(from_above({0.2, 0.3, 0.2}));
  EXPECT_NEAR(world.thing("above").thing.pose.position.y, 0.31, 1e-9);
  const auto scene = world.scene();
  ASSERT_TRUE(scene.held);
  EXPECT_NEAR(scene.held->pose.position.z, 0, 1e-5);
  EXPECT_EQ(scene.things.size(), 1u);
  EXPECT_EQ(world.open_gripper(), "below");
  EXPECT_NEAR(world.thing("below").thing.pose.position.z, 0.02, 1e-5);
  EXPECT_NEAR(world.thing("above").thing.pose.position.z, 0.06, 1e-5);
  EXPECT_EQ(world.thing("above").support, "below");
  EXPECT_EQ(world.held(), nullptr);
}

TEST(TableWorld, WhatStandsOutsideOfTheFingersIsNotBetweenThem) {
  auto world = table();
  world.add(cube_at("the cube", 0.2, 0.06, 0.02));
  EXPECT_NE(world.between_fingers(gripper, from_above({0.2, 0, 0.02}), 0.09), nullptr);
  EXPECT_EQ(world.between_fingers(gripper, from_above({0.2, 0, 0.02}), 0.07), nullptr);
  EXPECT_FALSE(world.close_gripper(gripper, from_above({0.2, 0, 0.02}), 0.07));
}

TEST(TableWorld, TheGripperClosesOnNothing) {
  auto world = table();
  world.add(cube_at("the cube", 0.2, 0, 0.1));
  EXPECT_FALSE(world.close_gripper(gripper, from_above({0.3, 0, 0.02}), gripper.widest));
  EXPECT_FALSE(world.open_gripper());
}

TEST(TableWorld, WhatStoodOnAThingFallsWhenThatIsTakenAway) {
  auto world = table();
  world.add(cube_at("below", 0.2, 0, 0.1));
  world.add(cube_at("above", 0.2, 0, 0.1));
  world.remove("below");
  EXPECT_EQ(world.things().size(), 1u);
  EXPECT_EQ(world.thing("above").support, "the table");
  EXPECT_NEAR(world.thing("above").thing.pose.position.z, 0.02, 1e-5);
}

TEST(TableWorld, RefusesNamesThatAreTakenOrUnknown) {
  auto world = table();
  world.add(cube_at("the cube", 0.2, 0, 0.1));
  EXPECT_THROW(world.add(cube_at("the cube", 0, 0, 0.1)), std::invalid_argument);
  EXPECT_THROW(world.add(thing("flat", box(0.1, 0, 0.1), 0, 0, 1)), std::invalid_argument);
  EXPECT_THROW(world.remove("the moon"), std::invalid_argument);
}

RC_GTEST_PROP(TableWorld, ThingsAreNeverInOneAnother, (std::uint32_t seed)) {
  std::mt19937 random(seed);
  std::uniform_real_distribution place(-0.3, 0.3);
  auto world = table();
  for (int i = 0; i < 8; ++i) {
    const Solid solids[]{box(0.06, 0.04, 0.05), cylinder(0.05, 0.08), sphere(0.06)};
    world.add(thing(std::to_string(i), solids[random() % 3], place(random), place(random), 0.5));
  }
  for (const auto& a : world.things())
    for (const auto& b : world.things())
      if (a.thing.name < b.thing.name && a.support != "the floor" && b.support != "the floor")
        RC_ASSERT(!overlap(a.thing, b.thing));
}

} // namespace castor::manipulation
