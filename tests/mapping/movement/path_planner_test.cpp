#include "castor/mapping/movement/path_planner.hpp"

#include "castor/tests/mapping/movement/drawn_map.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <cstddef>

namespace castor::mapping {

namespace {

using testing::HasSubstr;

PlannedPath plan(const CellMap& map, const Point2& a, const Point2& b,
                 const PlanOptions& options = {}) {
  return plan_path(map, ClearanceMap(map, options.cells), a, b, options);
}

TEST(PathPlanner, GoesStraightWhereItCan) {
  const auto path = plan(test::empty_room(6, 4), {1, 1}, {5, 2.7});
  ASSERT_EQ(path.points.size(), 2u) << path.reason;
  EXPECT_NEAR(path.length, std::hypot(4, 1.7), 1e-9);
}

TEST(PathPlanner, GoesAroundACornerByNearlyTheShortestWay) {
  auto map = test::empty_room(6, 4);
  test::fill(map, 2.9, 0, 3.1, 2.5);
  PlanOptions options;
  options.narrowness = 0;
  const auto path = plan(map, {1.5, 1}, {4.5, 1}, options);
  // A tangent to the circle of 0.3 m around each corner at the top of the wall, and its arc.
  const double away = std::hypot(1.4, 1.5);
  const double tangent = std::sqrt(away * away - 0.3 * 0.3);
  const double rise = std::atan2(1.5, 1.4) + std::asin(0.3 / away);
  const double shortest = 2 * (tangent + 0.3 * rise) + 0.2;
  EXPECT_GT(path.length, 0.95 * shortest) << path.reason;
  EXPECT_LT(path.length, 1.083 * shortest);
}

TEST(PathPlanner, PrefersAWideDoorToANarrowOneThatIsLittleShorter) {
  auto map = test::empty_room(6, 4);
  test::fill(map, 2.95, 0, 3.05, 4);
  test::fill(map, 2.95, 1.65, 3.05, 2.3, 0);
  test::fill(map, 2.95, 2.5, 3.05, 3.9, 0);
  const auto path = plan(map, {1, 2.38}, {5, 2.38});
  ASSERT_FALSE(path.points.empty()) << path.reason;
  for (auto& x : path.points)
    EXPECT_TRUE(std::abs(x.x - 3) > 0.3 || x.y > 2.7) << x.x << ' ' << x.y;
}

TEST(PathPlanner, SaysWhyThereIsNoWay) {
  auto map = test::empty_room(6, 4);
  test::fill(map, 2.95, 0, 3.05, 4);
  EXPECT_THAT(plan(map, {1, 2}, {3, 2}).reason, HasSubstr("inside an obstacle"));
  EXPECT_THAT(plan(map, {1, 2}, {3.2, 2}).reason, HasSubstr("0.1"));
  EXPECT_THAT(plan(map, {1, 2}, {9, 2}).reason, HasSubstr("not explored yet"));
  EXPECT_THAT(plan(map, {1, 2}, {5, 2}).reason, HasSubstr("obstacles are all around"));
  PlanOptions impatient;
  impatient.start_tolerance = 0.1;
  EXPECT_THAT(plan(map, {3, 2}, {5, 2}, impatient).reason, HasSubstr("too near to obstacles"));
  test::fill(map, 2.95, 1.8, 3.05, 2.2, 0);
  EXPECT_THAT(plan(map, {1, 2}, {5, 2}).reason,
              testing::MatchesRegex("no way: the passage at \\((2.9|3.0).*, (1.9|2.0).*\\) is "
                                    "0.(35|40|45) m wide, the robot needs 0.60 m"));
  test::fill(map, 2.95, 1.2, 3.05, 2.8, -1);
  EXPECT_EQ(plan(map, {1, 2}, {5, 2}).reason,
            "no way is known: what is between is not explored yet");
  PlanOptions daring;
  daring.cells.unknown_is_obstacle = false;
  EXPECT_FALSE(plan(map, {1, 2}, {5, 2}, daring).points.empty());
}

TEST(PathPlanner, LeavesAStartThatIsTooNearToAWall) {
  const auto path = plan(test::empty_room(6, 4), {0.2, 2}, {5, 2});
  ASSERT_GE(path.points.size(), 2u) << path.reason;
  EXPECT_EQ(path.points.front(), (Point2{0.2, 2}));
  EXPECT_EQ(path.points.back(), (Point2{5, 2}));
}

TEST(PathPlanner, LeavesANarrowPlaceThatItHasComeInto) {
  // Two halves of a room, with a passage of 0.55 to 0.6 m between them.
  auto map = test::empty_room(8, 4);
  test::fill(map, 3.95, 0, 4.05, 1.7);
  test::fill(map, 3.95, 2.3, 4.05, 4);
  const auto near = plan(map, {3, 2}, {7, 2});
  EXPECT_FALSE(near.points.empty()) << near.reason;
  const auto far = plan(map, {1, 2}, {7, 2});
  EXPECT_TRUE(far.points.empty()) << "too narrow to go there";
  test::fill(map, 3.95, 0, 4.05, 1.8);
  test::fill(map, 3.95, 2.2, 4.05, 4);
  EXPECT_TRUE(plan(map, {3, 2}, {7, 2}).points.empty()) << "narrower than the robot";
}

RC_GTEST_PROP(PathPlanner, KeepsTheClearanceEverywhere, ()) {
  auto map = test::empty_room(5, 4);
  for (int i = *rc::gen::inRange(0, 8); i > 0; --i) {
    const double x = *rc::gen::inRange(0, 100) * 0.05;
    const double y = *rc::gen::inRange(0, 80) * 0.05;
    test::fill(map, x, y, x + *rc::gen::inRange(1, 20) * 0.05, y + *rc::gen::inRange(1, 20) * 0.05);
  }
  const ClearanceMap clearance(map);
  const Point2 a{*rc::gen::inRange(0, 100) * 0.05, *rc::gen::inRange(0, 80) * 0.05};
  const Point2 b{*rc::gen::inRange(0, 100) * 0.05, *rc::gen::inRange(0, 80) * 0.05};
  RC_PRE(clearance.at(a) > 0.31);
  PlanOptions options;
  options.escape = 0;
  const auto path = plan(map, a, b, options);
  RC_ASSERT(path.points.empty() != path.reason.empty());
  for (std::size_t i = 1; i < path.points.size(); ++i)
    RC_ASSERT(is_clear(clearance, path.points[i - 1], path.points[i], 0.3));
}

} // namespace

} // namespace castor::mapping
