#include "castor/planning/body/table_things.hpp"

#include "castor/mapping/geometry/camera_model.hpp"
#include "castor/mapping/geometry/poses.hpp"
#include "castor/perception/vision/tabletop/tabletop_renderer.hpp"
#include "castor/perception/vision/tabletop/tabletop_scene_parser.hpp"
#include "castor/planning/manipulation/arm_placement.hpp"
#include "castor/planning/manipulation/manipulation_planner.hpp"
#include "castor/tests/planning/body/arm_at_table.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <variant>

namespace castor::manipulation {

namespace {

vision::TabletopScene scene_of(const std::string& things) {
  return vision::parse_tabletop_scene(
           "camera 0 -0.34 0.92 looking-at 0 0.02 0 fov 38\nimage 320 240\n" + things, "test")
    .scene;
}

const Pose before_the_table = arm_placement("0 -0.37 heading 90");

/// Labels of all bodies that are in the picture, and of how many pixels.
std::map<int, int> seen_in(const vision::TabletopScene& scene, const TableThings& things,
                           const ArmBody& body) {
  const auto labels =
    vision::render_labels(snapshot_of(scene.setting, things.view(body)), scene.camera);
  std::map<int, int> result;
  for (const auto x : labels.bytes)
    ++result[x];
  return result;
}

TEST(TableThings, HaveTheirPlacesOfTheScene) {
  const auto scene = scene_of("red cube at 0.1 0.05 size 0.05 turned 30\n"
                              "red cube at -0.1 0.05 size 0.05\n"
                              "blue sphere at 0.1 -0.1 size 0.06 name=ball\n");
  const TableThings things(scene.at({}), before_the_table);
  const auto world = things.world();
  ASSERT_EQ(world.things().size(), 3u);
  EXPECT_EQ(world.things()[1].thing.name, "the red cube 2");
  EXPECT_EQ(world.things()[2].thing.name, "ball");
  // The arm's x axis is the table's y axis.
  const auto& cube = world.thing("the red cube").thing.pose;
  EXPECT_NEAR(cube.position.x, 0.42, 1e-6);
  EXPECT_NEAR(cube.position.y, -0.1, 1e-6);
  const auto back = things.on_table(cube);
  EXPECT_NEAR(back.position.x, 0.1, 1e-6);
  EXPECT_NEAR(back.position.y, 0.05, 1e-6);
  EXPECT_EQ(back.frame, "table");
}

TEST(TableThings, AreRenderedAsTheSceneIs) {
  const auto scene = scene_of("red cube at 0.1 0.05 size 0.05 turned 30\n"
                              "blue sphere at 0.1 -0.1 size 0.06\n"
                              "green triangle at -0.1 -0.1 size 0.09 turned 20\n");
  const TableThings things(scene.at({}), before_the_table);
  const ArmBody body(katana(), things.world(), aside());
  const auto one = vision::render_labels(scene.at({}), scene.camera);
  const auto other =
    vision::render_labels(snapshot_of(scene.setting, things.view(body)), scene.camera);
  int different = 0;
  for (std::size_t i = 0; i < one.bytes.size(); ++i)
    different += one.bytes[i] != other.bytes[i];
  EXPECT_LE(different, 4);
}

TEST(TableThings, TheArmAtRestIsNotInThePictureAndHidesThingsElsewhere) {
  const auto scene = scene_of("red cube at 0 -0.12 size 0.05\n");
  const TableThings things(scene.at({}), before_the_table);
  const auto arm = katana();
  const ArmBody resting(arm, things.world(), aside());
  const auto alone = seen_in(scene, things, resting);
  EXPECT_EQ(alone.size(), 2u) << "the table and the cube";
  // Over the cube.
  const ArmBody reaching(arm, things.world(), {0, 20 * degree, 60 * degree, 60 * degree, 0});
  const auto both = seen_in(scene, things, reaching);
  EXPECT_GT(both.size(), 4u);
  EXPECT_LT(both.contains(1) ? both.at(1) : 0, alone.at(1) / 2);
}

TEST(TableThings, WhatIsCarriedIsSeenWhereItIs) {
  const auto scene = scene_of("blue sphere at 0.1 -0.1 size 0.06\n");
  const TableThings things(scene.at({}), before_the_table);
  const auto arm = katana();
  ArmBody body(arm, things.world(), aside());
  const ManipulationPlanner planner(arm);
  const auto plan = planner.pick(body.world().scene(), "the blue sphere", aside());
  ASSERT_TRUE(std::holds_alternative<ManipulationPlan>(plan));
  std::int64_t number = 0;
  for (const auto& stage : std::get<ManipulationPlan>(plan).stages)
    ASSERT_TRUE(carry_out(body, stage, ++number));
  const auto view = things.view(body);
  EXPECT_EQ(view.front().shape, ViewedShape::sphere);
  EXPECT_GT(view.front().pose.position.z, 0.07);
  EXPECT_NEAR(view.front().pose.position.x, 0.1, 0.01);
}

} // namespace

} // namespace castor::manipulation
