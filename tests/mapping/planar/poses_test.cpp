// Poses on the floor.

#include "castor/mapping/planar/poses.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <numbers>

namespace castor::mapping::test {

namespace {

using std::numbers::pi;

constexpr double exact = 1e-9;

void expect_near(const Pose2& a, const Pose2& b, double tolerance = exact) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(normalised(a.heading - b.heading), 0, tolerance);
}

Pose2 any_pose() {
  auto number = [] { return *rc::gen::inRange(-10000, 10000) / 1000.; };
  return {number(), number(), normalised(number())};
}

TEST(Poses, HeadingsAreWithinOneTurn) {
  EXPECT_DOUBLE_EQ(normalised(pi), pi);
  EXPECT_DOUBLE_EQ(normalised(-pi), pi);
  EXPECT_NEAR(normalised(7 * pi / 2), -pi / 2, exact);
  EXPECT_DOUBLE_EQ(normalised(0), 0);
}

TEST(Poses, AThingOnABody) {
  expect_near(compose({1, 2, pi / 2}, {3, 0, pi / 2}), {1, 5, pi});
  expect_near(compose({1, 2, pi / 2}, {0, 1, 0}), {0, 2, pi / 2});
}

TEST(Poses, InterpolationTakesTheShorterWayRound) {
  expect_near(interpolate({0, 0, 3}, {2, 4, -3}, 0.5), {1, 2, pi});
}

TEST(Poses, ABodyThatTurnsMovesAlongAnArc) {
  // A quarter of a circle of radius 2.
  expect_near(moved({0, 0, 0}, {pi, pi / 2}, 1), {2, 2, pi / 2});
  expect_near(moved({1, 1, pi / 2}, {2, 0}, 3), {1, 7, pi / 2});
  expect_near(moved({0, 0, 0}, {0, 1}, 0.5), {0, 0, 0.5});
}

RC_GTEST_PROP(Poses, WhatIsBetweenTwoLeadsFromOneToTheOther, ()) {
  auto a = any_pose();
  auto b = any_pose();
  expect_near(compose(a, between(a, b)), b);
  expect_near(compose(inverse(a), a), {});
}

RC_GTEST_PROP(Poses, ManySmallMovesAreALargeOne, ()) {
  auto start = any_pose();
  Twist2 velocity{*rc::gen::inRange(-200, 200) / 100., *rc::gen::inRange(-300, 300) / 100.};
  auto pose = start;
  for (int i = 0; i < 50; ++i)
    pose = moved(pose, velocity, 0.02);
  expect_near(pose, moved(start, velocity, 1), 1e-7);
}

} // namespace

} // namespace castor::mapping::test
