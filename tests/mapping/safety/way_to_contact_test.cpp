// How far a disc moves along an arc until it touches a point, against small steps along it.

#include "castor/mapping/safety/way_to_contact.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace castor::mapping {

namespace {

constexpr double never = std::numeric_limits<double>::infinity();

double between_numbers(double low, double high) {
  return low + (high - low) * *rc::gen::inRange(0, 100'001) / 100'000.0;
}

} // namespace

TEST(WayToContact, IsThatToTheEdgeOfTheDisc) {
  EXPECT_NEAR(way_to_contact({2, 0}, 0, 0.25), 1.75, 1e-12);
  EXPECT_NEAR(way_to_contact({2, 0.15}, 0, 0.25), 1.8, 1e-12);
  EXPECT_EQ(way_to_contact({2, 0.26}, 0, 0.25), never);
  EXPECT_EQ(way_to_contact({-2, 0}, 0, 0.25), never);
  // A quarter of a circle of 1 m to the left leads to (1, 1), where the disc faces up.
  const double quarter = std::numbers::pi / 2;
  EXPECT_NEAR(way_to_contact({1, 1}, 1, 0.25), quarter - 2 * std::asin(0.125), 1e-9);
  EXPECT_NEAR(way_to_contact({1, -1}, -1, 0.25), quarter - 2 * std::asin(0.125), 1e-9);
  EXPECT_EQ(way_to_contact({3, 0}, 1, 0.25), never);
}

TEST(WayToContact, OfWhatItTouchesDependsOnTheSide) {
  EXPECT_EQ(way_to_contact({0.2, 0}, 0, 0.25), 0);
  EXPECT_EQ(way_to_contact({-0.2, 0}, 0, 0.25), never);
  EXPECT_EQ(way_to_contact({-0.2, 0.1}, 2, 0.25), never);
}

RC_GTEST_PROP(WayToContactProperties, IsThatOfSmallSteps, ()) {
  const Point2 p{between_numbers(-4, 4), between_numbers(-4, 4)};
  const double curvature = between_numbers(-3, 3);
  const double radius = between_numbers(0.05, 0.4);
  RC_PRE(std::hypot(p.x, p.y) > radius + 0.01);
  constexpr double step = 0.001;
  const double round =
    std::abs(curvature) > 0.01 ? std::min(10.0, 2 * std::numbers::pi / std::abs(curvature)) : 10;
  double found = never;
  double least = never;
  for (double way = 0; way < round; way += step) {
    const auto pose = moved({}, {1, curvature}, way);
    const double left = distance(Point2{pose.x, pose.y}, p);
    least = std::min(least, left);
    if (left <= radius) {
      found = way;
      break;
    }
  }
  const double calculated = way_to_contact(p, curvature, radius);
  if (found < never)
    RC_ASSERT(std::abs(calculated - found) < 0.01 || least > radius - 0.0005);
  else
    // It may be beyond the steps, or be touched between two of them.
    RC_ASSERT(calculated >= round - 0.01 || least < radius + 0.0005);
}

} // namespace castor::mapping
