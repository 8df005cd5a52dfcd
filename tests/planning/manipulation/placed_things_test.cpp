#include "castor/planning/manipulation/placed_things.hpp"

#include <gtest/gtest.h>

namespace castor::manipulation {

namespace {

SeenThing seen(const std::string& id, const std::string& shape, const Solid& solid, double x,
               double y) {
  SeenThing result;
  result.id = id;
  result.colour = "green";
  result.shape = shape;
  result.thing.name = "the green " + shape;
  result.thing.solid = solid;
  result.thing.pose = {{x, y, solid.size.z / 2}, {}, arm_frame};
  return result;
}

const auto cube = box(0.05, 0.05, 0.05);

} // namespace

TEST(PlacedThings, AreAsLargeAsBeforeInTheShadowToo) {
  PlacedThings placed;
  const Pose there{{0.23, -0.05, 0.029}, {}, arm_frame};
  placed.put("new", seen("old", "cube", cube, 0.4, 0.1), there, 0.004);
  std::vector<SeenThing> things{seen("new", "cube", box(0.05, 0.05, 0.03), 0.24, -0.04),
                                seen("other", "cube", box(0.04, 0.04, 0.03), 0.24, 0.1)};
  placed.correct(things);
  EXPECT_EQ(things[0].thing.solid.size.z, 0.05);
  EXPECT_EQ(things[0].thing.pose.position.x, 0.23);
  EXPECT_EQ(things[0].id, "new");
  EXPECT_EQ(placed.fall_of("new"), 0.004);
  EXPECT_EQ(things[1].thing.solid.size.z, 0.03);
}

TEST(PlacedThings, ABallThatLooksLikeADiscIsABall) {
  PlacedThings placed;
  const Pose there{{0.2, 0, 0.025}, {}, arm_frame};
  placed.put("1", seen("1", "sphere", sphere(0.05), 0.4, 0.1), there);
  std::vector<SeenThing> things{seen("1", "circle", cylinder(0.05, 0.005), 0.2, 0.01)};
  placed.correct(things);
  EXPECT_EQ(things[0].thing.solid.kind, SolidKind::sphere);
  EXPECT_EQ(things[0].thing.pose.position.z, 0.025);
}

TEST(PlacedThings, AreWhereTheyAreSeenIfTheyAreSeenAsLarge) {
  PlacedThings placed;
  const Pose there{{0.2, 0, 0.029}, {}, arm_frame};
  placed.put("1", seen("1", "cube", cube, 0.4, 0.1), there, 0.004);
  std::vector<SeenThing> things{seen("1", "cube", box(0.051, 0.051, 0.051), 0.21, 0.01)};
  placed.correct(things);
  EXPECT_EQ(things[0].thing.solid.size.z, 0.051);
  EXPECT_EQ(things[0].thing.pose.position.x, 0.21);
  EXPECT_EQ(placed.fall_of("1"), 0);
}

/// It looks larger, and farther away, than it is.
TEST(PlacedThings, OnAnotherThingTheyAreAsHighAsTheyWerePut) {
  PlacedThings placed;
  const Pose there{{0.2, 0, 0.075}, {}, arm_frame};
  placed.put("1", seen("1", "cube", cube, 0.4, 0.1), there);
  std::vector<SeenThing> things{seen("1", "cube", box(0.052, 0.052, 0.052), 0.22, 0)};
  placed.correct(things);
  EXPECT_EQ(things[0].thing.pose, there);
  // The higher, the farther away.
  const Pose higher{{0.2, 0, 0.105}, {}, arm_frame};
  placed.put("1", seen("1", "cube", cube, 0.4, 0.1), higher);
  things = {seen("1", "cube", box(0.052, 0.052, 0.052), 0.26, 0)};
  placed.correct(things);
  EXPECT_EQ(things[0].thing.pose, higher);
}

TEST(PlacedThings, AreForgottenOnceSomebodyElseHasMovedThem) {
  PlacedThings placed;
  const Pose there{{0.2, 0, 0.025}, {}, arm_frame};
  placed.put("1", seen("1", "cube", cube, 0.4, 0.1), there);
  const auto small = box(0.03, 0.03, 0.03);
  std::vector<SeenThing> moved{seen("1", "cube", small, 0.3, 0)};
  placed.correct(moved);
  EXPECT_EQ(moved[0].thing.solid.size.z, 0.03);
  std::vector<SeenThing> back{seen("1", "cube", small, 0.2, 0)};
  placed.correct(back);
  EXPECT_EQ(back[0].thing.solid.size.z, 0.03);
  // Or put something of another colour there.
  placed.put("1", seen("1", "cube", cube, 0.4, 0.1), there);
  std::vector<SeenThing> red{seen("1", "cube", small, 0.2, 0)};
  red[0].colour = "red";
  placed.correct(red);
  EXPECT_EQ(red[0].thing.solid.size.z, 0.03);
}

/// In a tower, a thing may be seen as a new one; and one that was taken away is nowhere else.
TEST(PlacedThings, OfATowerAreKnownAgainUntilTheyAreTaken) {
  PlacedThings placed;
  const Pose high{{0.3, 0, 0.13}, {}, arm_frame};
  placed.put("1", seen("0", "cube", cube, 0.4, 0.1), high, 0.004);
  EXPECT_EQ(placed.fall_of("1"), 0.004);
  std::vector<SeenThing> things{seen("2", "cube", cube, 0.36, 0.01),
                                seen("below", "cube", cube, 0.3, 0)};
  things[1].colour = "red";
  things[1].thing.higher = 0.01;
  placed.correct(things);
  EXPECT_EQ(things[0].thing.pose.position.z, 0.13);
  EXPECT_EQ(things[1].thing.higher, 0);
  EXPECT_EQ(placed.fall_of("2"), 0.004);
  placed.forget("2");
  things[0] = seen("2", "cube", cube, 0.36, 0.01);
  placed.correct(things);
  EXPECT_EQ(things[0].thing.pose.position.z, 0.025);
}

} // namespace castor::manipulation
