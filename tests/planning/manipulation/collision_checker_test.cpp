#include "castor/planning/manipulation/collision_checker.hpp"

#include "castor/planning/manipulation/kinematics.hpp"
#include "castor/tests/planning/manipulation/katana.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

namespace castor::manipulation {

namespace {

using std::numbers::pi;

/// Straight up, and stretched out forward, horizontally.
const Configuration upright(5, 0);
const Configuration forward{0, pi / 2, 0, 0, 0};

} // namespace

TEST(CollisionChecker, NamesWhatTouchesWhat) {
  CollisionChecker checker(katana(), {{thing("the box", box(0.1, 0.1, 0.1), 0.3, 0, 0.2)}, {}});
  EXPECT_TRUE(checker.is_free(upright));
  const auto contact = checker.contact(forward);
  ASSERT_TRUE(contact);
  EXPECT_EQ(contact->other, "the box");
  EXPECT_EQ(contact->part, "the forearm");
  EXPECT_FALSE(contact->is_of_arm);
}

TEST(CollisionChecker, KnowsAllKindsOfSolids) {
  for (const auto& solid :
       {box(0.06, 0.06, 0.06), cylinder(0.06, 0.06), capsule(0.06, 0.06), sphere(0.06)}) {
    SCOPED_TRACE(to_string(solid.kind));
    // The forearm is 0.055 m thick at a height of 0.2015 m: 0.6 mm away, and 9.4 mm.
    CollisionChecker near(katana(), {{thing("it", solid, 0.26, 0, 0.2015 + 0.0275 + 0.0306)}, {}});
    EXPECT_FALSE(near.is_free(forward));
    CollisionChecker far(katana(), {{thing("it", solid, 0.26, 0, 0.2015 + 0.0275 + 0.0394)}, {}});
    EXPECT_TRUE(far.is_free(forward));
    CollisionOptions exact;
    exact.margin = 0;
    CollisionChecker touching(katana(),
                              {{thing("it", solid, 0.26, 0, 0.2015 + 0.0275 + 0.0306)}, {}}, exact);
    EXPECT_TRUE(touching.is_free(forward));
    EXPECT_NEAR(touching.clearance(forward), 0.0006, 0.0002);
  }
}

TEST(CollisionChecker, KeepsAwayFromWhatIsNotKnownExactly) {
  // 9.4 mm away.
  auto it = thing("it", box(0.06, 0.06, 0.06), 0.26, 0, 0.2015 + 0.0275 + 0.0394);
  EXPECT_TRUE(CollisionChecker(katana(), {{it}, {}}).is_free(forward));
  it.uncertainty = 0.004;
  EXPECT_TRUE(CollisionChecker(katana(), {{it}, {}}).is_free(forward));
  it.uncertainty = 0.005;
  EXPECT_FALSE(CollisionChecker(katana(), {{it}, {}}).is_free(forward));
}

TEST(CollisionChecker, KeepsAwayFromWhereAThingMayReachUpTo) {
  // Below the forearm, which is 0.055 m thick, and 9.4 mm away; then above it.
  auto below = thing("it", box(0.06, 0.06, 0.06), 0.26, 0, 0.2015 - 0.0275 - 0.0394);
  auto above = thing("it", box(0.06, 0.06, 0.06), 0.26, 0, 0.2015 + 0.0275 + 0.0394);
  for (auto* it : {&below, &above})
    it->higher = 0.004;
  EXPECT_TRUE(CollisionChecker(katana(), {{below}, {}}).is_free(forward));
  for (auto* it : {&below, &above})
    it->higher = 0.005;
  EXPECT_FALSE(CollisionChecker(katana(), {{below}, {}}).is_free(forward));
  EXPECT_TRUE(CollisionChecker(katana(), {{above}, {}}).is_free(forward));
}

TEST(CollisionChecker, TheArmMayNotTouchItself) {
  CollisionChecker checker(katana(), {});
  EXPECT_TRUE(checker.is_free(katana().home));
  // The hand bent back onto the upper arm.
  const auto contact = checker.contact(Configuration{0, 0, 2.0, 1.8, 0});
  ASSERT_TRUE(contact);
  EXPECT_TRUE(contact->is_of_arm);
}

TEST(CollisionChecker, WhatIsHeldIsAPartOfTheArm) {
  // Beyond the fingers, in the way of nothing but a long rod in the hand.
  const auto ball = thing("the ball", sphere(0.04), 0.642 + 0.1, 0, 0.2015);
  CollisionChecker empty(katana(), {{ball}, {}});
  EXPECT_TRUE(empty.is_free(forward));
  CollisionChecker holding(katana(), {{ball}, NamedSolid{"the rod", cylinder(0.02, 0.2), {}}});
  const auto contact = holding.contact(forward);
  ASSERT_TRUE(contact);
  EXPECT_EQ(contact->part, "the rod");
  EXPECT_EQ(contact->other, "the ball");
}

TEST(CollisionChecker, TheGripperMayTouchWhatItGrasps) {
  const auto cube = thing("the cube", box(0.04, 0.04, 0.04), 0.642, 0, 0.2015);
  CollisionOptions options;
  options.opening = 0.04;
  EXPECT_FALSE(CollisionChecker(katana(), {{cube}, {}}, options).is_free(forward));
  options.may_touch = {"the cube"};
  EXPECT_TRUE(CollisionChecker(katana(), {{cube}, {}}, options).is_free(forward));
  // But not with its forearm.
  CollisionChecker checker(
    katana(), {{thing("the cube", box(0.04, 0.04, 0.04), 0.25, 0, 0.2015)}, {}}, options);
  EXPECT_FALSE(checker.is_free(forward));
}

TEST(CollisionChecker, ClearanceIsTheDistanceOfTheNearestThing) {
  CollisionChecker checker(
    katana(),
    {{thing("near", sphere(0.1), 0.3, 0, 0.5), thing("far", sphere(0.1), 0.3, 0, 1)}, {}});
  EXPECT_NEAR(checker.clearance(forward), 0.5 - 0.05 - 0.2015 - 0.0275, 0.003);
  EXPECT_TRUE(std::isinf(CollisionChecker(katana(), {}).clearance(forward)));
}

TEST(CollisionChecker, NoPointMovesFurtherThanTheMarginInHalfAStep) {
  const auto arm = katana();
  CollisionChecker checker(arm, {});
  std::mt19937 random(3);
  for (int i = 0; i < 200; ++i) {
    const auto from = random_configuration(arm, random);
    auto direction = random_configuration(arm, random);
    const double length = distance(direction, Configuration(5, 0));
    auto to = from;
    for (std::size_t j = 0; j < 5; ++j)
      to[j] += direction[j] / length * checker.step() / 2;
    const auto a = tool_pose(arm, from).position;
    const auto b = tool_pose(arm, to).position;
    EXPECT_LT(std::hypot(a.x - b.x, a.y - b.y, a.z - b.z), 0.005);
  }
}

TEST(CollisionChecker, RefusesSolidsWithoutSize) {
  EXPECT_THROW(CollisionChecker(katana(), {{thing("it", box(0.1, 0, 0.1), 1, 0, 0)}, {}}),
               std::invalid_argument);
}

} // namespace castor::manipulation
