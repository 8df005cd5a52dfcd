#include "castor/planning/manipulation/seen_table.hpp"

#include "castor/mapping/geometry/poses.hpp"
#include "castor/planning/manipulation/arm_placement.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace castor::manipulation {

namespace {

vision::SceneObject object(const std::string& colour, const std::string& shape, double x,
                           double y) {
  vision::SceneObject result;
  result.colour = {colour, 0.9};
  result.shape = {shape, 0.9};
  result.box = {{x, y, 0.025}, {0.05, 0.05, 0.05}, "table"};
  return result;
}

const Pose before_the_table = arm_placement("0 -0.4 heading 90");

} // namespace

TEST(SeenTable, HasThingsByTheirBoxesInTheArmsFrame) {
  SeenEntries entries;
  entries.objects["1"] = object("red", "cube", 0.1, 0);
  const auto things = seen_things(entries, before_the_table);
  ASSERT_EQ(things.size(), 1u);
  EXPECT_EQ(things[0].id, "1");
  EXPECT_EQ(things[0].thing.name, "the red cube");
  EXPECT_NEAR(things[0].thing.pose.position.x, 0.4, 1e-9);
  EXPECT_NEAR(things[0].thing.pose.position.y, -0.1, 1e-9);
  const auto scene = scene_of(things);
  ASSERT_EQ(scene.things.size(), 2u);
  EXPECT_EQ(scene.things[0].name, "the table");
}

TEST(SeenTable, ThingsThatLookAlikeHaveDifferentNames) {
  SeenEntries entries;
  entries.objects["1"] = object("red", "cube", 0.1, 0);
  entries.objects["2"] = object("red", "cube", -0.1, 0);
  entries.objects["3"] = object("unknown", "unknown", 0, 0.1);
  const auto things = seen_things(entries, before_the_table);
  ASSERT_EQ(things.size(), 3u);
  EXPECT_EQ(things[1].thing.name, "the red cube 2");
  EXPECT_EQ(things[2].thing.name, "the thing");
}

TEST(SeenTable, ThingsWithoutAPlaceAreLeftOut) {
  SeenEntries entries;
  entries.objects["1"] = object("red", "cube", 0.1, 0);
  entries.objects["1"].box = {};
  EXPECT_TRUE(seen_things(entries, before_the_table).empty());
}

TEST(SeenTable, WhatIsSeenOfTheThingInTheGripperIsLeftOut) {
  SeenEntries entries;
  entries.objects["1"] = object("yellow", "cylinder", -0.24, -0.25);
  entries.objects["2"] = object("yellow", "cylinder", 0.1, 0);
  entries.objects["3"] = object("red", "cube", -0.24, -0.25);
  auto things = seen_things(entries, before_the_table);
  const auto held = things[0];
  auto at = held.thing.pose;
  at.position.z = 0.1;
  leave_out_held(things, held, at);
  ASSERT_EQ(things.size(), 2u);
  EXPECT_EQ(things[0].id, "2");
  EXPECT_EQ(things[1].id, "3");
}

TEST(SeenTable, FreePlacesAreAwayFromWhatIsSeen) {
  const auto all = free_places({}, 0.1);
  ASSERT_FALSE(all.empty());
  EXPECT_GT(free_places({}, 0.1, true).size(), all.size());
  SeenEntries entries;
  entries.objects["1"] = object("red", "cube", 0.1, 0);
  entries.objects["2"] = object("blue", "cube", -0.05, 0.05);
  const auto things = seen_things(entries, before_the_table);
  const auto free = free_places(things, 0.1);
  ASSERT_FALSE(free.empty());
  EXPECT_LT(free.size(), all.size());
  for (const auto& place : free)
    for (const auto& x : things)
      EXPECT_GT(distance_on_table(place, x.thing.pose.position), 0.1 / 2 + 0.025 + 0.04);
  const auto nearest = [&](const Point3& place) {
    return std::min(distance_on_table(place, things[0].thing.pose.position),
                    distance_on_table(place, things[1].thing.pose.position));
  };
  EXPECT_GT(nearest(free.front()), nearest(free.back()));
}

TEST(SeenTable, FindsTheNearestOfThatColourAndRatherOfThatShape) {
  SeenEntries entries;
  entries.objects["1"] = object("red", "cube", 0.1, 0);
  entries.objects["2"] = object("red", "sphere", 0.12, 0);
  entries.objects["3"] = object("blue", "cube", 0.11, 0);
  const auto things = seen_things(entries, before_the_table);
  const auto& cube = things[0];
  const auto place = things[1].thing.pose.position;
  EXPECT_EQ(find_like(things, cube, place, 0.05), &things[0]) << "the shape counts first";
  EXPECT_EQ(find_like(things, cube, place, 0.01), &things[1]);
  EXPECT_EQ(find_like(things, things[2], place, 0.005), nullptr);
}

} // namespace castor::manipulation
