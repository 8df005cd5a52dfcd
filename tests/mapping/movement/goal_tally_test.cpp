#include "castor/mapping/movement/goal_tally.hpp"

#include "castor/mapping/movement/path_planner.hpp"
#include "castor/tests/mapping/movement/drawn_map.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace castor::mapping {

namespace {

using testing::HasSubstr;

TEST(ReachableCells, GoesThroughWideDoorsOnly) {
  auto map = test::empty_room(6, 4);
  test::fill(map, 2.95, 0, 3.05, 4);
  test::fill(map, 2.95, 1.6, 3.05, 2.4, 0);
  const ReachableCells narrow(map, {1, 2}, 0.3);
  EXPECT_TRUE(narrow.can_be_at({5, 2}));
  EXPECT_FALSE(narrow.can_be_at({5, 0.2})) << "beside the wall";
  EXPECT_FALSE(narrow.can_be_at({7, 2})) << "outside the map";
  const ReachableCells wide(map, {1, 2}, 0.45);
  EXPECT_TRUE(wide.can_be_at({2, 2}));
  EXPECT_FALSE(wide.can_be_at({5, 2}));
}

TEST(ReachableCells, BeginsWhereTheDiscFits) {
  const auto map = test::empty_room(3, 3);
  EXPECT_TRUE(ReachableCells(map, {0.2, 1}, 0.3).can_be_at({2, 2}));
  EXPECT_FALSE(ReachableCells(map, {0.2, 1}, 0.3, 0.05).can_be_at({2, 2}));
}

TEST(ReachabilityCheck, IsInDoubtWhereAFootprintFitsAsItFacesOnly) {
  auto map = test::empty_room(6, 4);
  test::fill(map, 2.95, 0, 3.05, 4);
  test::fill(map, 2.95, 1.6, 3.05, 2.4, 0);
  const auto footprint = [&](const Point2& goal) {
    return ReachabilityCheck(map, {1, 2}, 0.3, 0.7).of(goal);
  };
  EXPECT_EQ(footprint({1.5, 2}), Reachability::reachable);
  EXPECT_EQ(footprint({5, 2}), Reachability::doubtful) << "behind the door";
  EXPECT_EQ(footprint({1, 0.5}), Reachability::doubtful) << "beside a wall";
  EXPECT_EQ(footprint({3, 0.5}), Reachability::unreachable) << "in a wall";
}

RC_GTEST_PROP(ReachabilityCheck, AgreesWithThePlanner, ()) {
  auto map = test::empty_room(5, 5, 0.1);
  const auto boxes = *rc::gen::inRange(0, 12);
  for (int i = 0; i < boxes; ++i) {
    const double x = *rc::gen::inRange(15, 50) * 0.1;
    const double y = *rc::gen::inRange(15, 50) * 0.1;
    test::fill(map, x, y, x + *rc::gen::inRange(1, 15) * 0.1, y + *rc::gen::inRange(1, 15) * 0.1);
  }
  const Point2 start{0.85, 0.85};
  const Point2 goal{*rc::gen::inRange(0, 50) * 0.1 + 0.05, *rc::gen::inRange(0, 50) * 0.1 + 0.05};
  PlanOptions options;
  options.escape = 0;
  const double needed = options.radius + options.margin;
  const ClearanceMap clearance(map, options.cells);
  const auto plan = plan_path(map, clearance, start, goal, options);
  const auto verdict = ReachabilityCheck(map, start, needed).of(goal);
  if (plan.points.empty())
    RC_ASSERT(verdict != Reachability::reachable);
  else
    RC_ASSERT(verdict != Reachability::unreachable);
}

TEST(GoalTally, TellsHonestRefusalsFromWrongOnes) {
  GoalTally x;
  GoalOutcome reached;
  reached.is_reached = true;
  reached.driven = 3;
  reached.shortest = 2;
  reached.waited = 4;
  x.add(reached);
  GoalOutcome refused;
  refused.reachability = Reachability::unreachable;
  x.add(refused);
  x.add(refused);
  refused.reachability = Reachability::reachable;
  refused.collisions = 1;
  x.add(refused);
  refused.reachability = Reachability::doubtful;
  x.add(refused);
  x.add_plan(0.004);
  EXPECT_EQ(x.goals(), 5u);
  EXPECT_EQ(x.reached(), 1u);
  EXPECT_EQ(x.honestly_refused(), 2u);
  EXPECT_EQ(x.wrongly_refused(), 1u);
  EXPECT_EQ(x.collisions(), 2);
  EXPECT_THAT(x.text(), HasSubstr("5 goals: 1 reached, 2 refused honestly, 1 wrongly, 1 in doubt; "
                                  "2 collisions; 3.0 m driven, 1.500 of the shortest"));
  EXPECT_THAT(x.text(), HasSubstr("4.0 ms (p50)"));
}

} // namespace

} // namespace castor::mapping
