// How far a disc or what has corners moves until it touches a point, against small steps.

#include "castor/mapping/body/footprint.hpp"
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

/// 1.2 by 0.5 m about its middle, and a car that turns about its rear axle.
const Polygon table{{0.6, 0.25}, {-0.6, 0.25}, {-0.6, -0.25}, {0.6, -0.25}};
const Polygon car{{0.55, 0.22}, {-0.15, 0.22}, {-0.15, -0.22}, {0.55, -0.22}};

double gap_at(const Polygon& outline, const Pose2& robot, const Point2& p) {
  return Footprint{outline}.distance_from(transform(inverse(robot), p));
}

/// By steps of a millimetre of the outermost point.
/// @param least becomes the smallest gap on the way
double stepped(const Polygon& outline, const Point2& p, const Twist2& velocity, double whole,
               double gap, double& least) {
  const Footprint footprint{outline};
  const double step =
    0.001 / (std::abs(velocity.forward) + std::abs(velocity.turn) * footprint.outer_radius());
  least = never;
  for (double at = 0; at < whole; at += step) {
    least = std::min(least, footprint.distance_from(
                              transform(inverse(moved({}, velocity, at)), p)));
    if (least <= gap)
      return at;
  }
  return never;
}

/// The calculated number is that of the steps, or the outline passes the point closely.
void expect_agreement(double calculated, double by_steps, double whole, double least, double gap) {
  if (by_steps < never)
    RC_ASSERT(std::abs(calculated - by_steps) < 0.02 || least > gap - 0.001);
  else
    RC_ASSERT(calculated >= whole - 0.02 || least < gap + 0.001);
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

TEST(OutlineContact, IsThatOfTheFirstSideOrCorner) {
  EXPECT_NEAR(way_to_contact({2, 0}, 0, table, 0), 1.4, 1e-12);
  EXPECT_NEAR(way_to_contact({2, 0.2}, 0, table, 0.1), 1.3, 1e-12);
  // The corner is a quarter of a circle of 0.1 m.
  EXPECT_NEAR(way_to_contact({2, 0.31}, 0, table, 0.1), 2 - 0.6 - 0.08, 1e-12);
  EXPECT_EQ(way_to_contact({2, 0.36}, 0, table, 0.1), never);
  EXPECT_EQ(way_to_contact({-2, 0}, 0, table, 0.1), never);
  // A car swings out: its rear corner is on a circle around (0, 1).
  const double rear = std::hypot(0.15, 1.22);
  EXPECT_EQ(way_to_contact({-0.5, -0.4}, 1, car, 0), never);
  EXPECT_LT(way_to_contact({0, 1 - (rear - 0.001)}, 1, car, 0), 1);
  EXPECT_EQ(way_to_contact({0, 1 - (rear - 0.001)}, 0, car, 0), never);
}

TEST(OutlineContact, TurnsOnTheSpot) {
  using std::numbers::pi;
  // The front left corner, at 22.6 degrees, gets to 90 degrees.
  const double corner = std::atan2(0.25, 0.6);
  EXPECT_NEAR(turn_to_contact({0, 0.65}, true, table, 0), pi / 2 - corner, 1e-9);
  EXPECT_NEAR(turn_to_contact({0, 0.65}, false, table, 0), pi / 2 - corner, 1e-9);
  EXPECT_NEAR(turn_to_contact({0, -0.65}, true, table, 0), pi / 2 - corner, 1e-9);
  EXPECT_EQ(turn_to_contact({0, 0.66}, true, table, 0), never);
}

TEST(OutlineContact, OfWhatIsNearDependsOnTheDirection) {
  EXPECT_EQ(way_to_contact({0.63, 0}, 0, table, 0.05), 0);
  EXPECT_EQ(way_to_contact({-0.63, 0}, 0, table, 0.05), never);
  // It drives along a wall, and not towards it.
  EXPECT_EQ(way_to_contact({0, 0.28}, 0, table, 0.05), never);
  EXPECT_EQ(way_to_contact({0.3, 0.28}, 0.5, table, 0.05), 0);
  // Turning away from what is at its side, its other end comes there.
  EXPECT_EQ(turn_to_contact({0.5, 0.28}, true, table, 0.05), 0);
  const double again = turn_to_contact({0.5, 0.28}, false, table, 0.05);
  EXPECT_GT(again, 1);
  EXPECT_LT(again, 3.2);
}

RC_GTEST_PROP(OutlineContactProperties, IsThatOfSmallSteps, ()) {
  const Point2 p{between_numbers(-2, 2), between_numbers(-2, 2)};
  const auto& outline = *rc::gen::arbitrary<bool>() ? table : car;
  const double gap = between_numbers(0, 0.2);
  RC_PRE(gap_at(outline, {}, p) > gap + 0.01);
  const double curvature = between_numbers(-2, 2);
  const double whole =
    std::min(4.0, 2 * std::numbers::pi / std::max(0.01, std::abs(curvature)));
  double least = never;
  const double found = stepped(outline, p, {1, curvature}, whole, gap, least);
  expect_agreement(way_to_contact(p, curvature, outline, gap), found, whole, least, gap);
}

RC_GTEST_PROP(OutlineContactProperties, IsThatOfSmallTurns, ()) {
  const Point2 p{between_numbers(-1, 1), between_numbers(-1, 1)};
  const auto& outline = *rc::gen::arbitrary<bool>() ? table : car;
  const double gap = between_numbers(0, 0.2);
  RC_PRE(gap_at(outline, {}, p) > gap + 0.01);
  const bool is_left = *rc::gen::arbitrary<bool>();
  const double whole = 2 * std::numbers::pi;
  double least = never;
  const double found = stepped(outline, p, {0, is_left ? 1.0 : -1.0}, whole, gap, least);
  expect_agreement(turn_to_contact(p, is_left, outline, gap), found, whole, least, gap);
}

} // namespace castor::mapping
