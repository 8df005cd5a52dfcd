#include "castor/mapping/movement/goal_pursuit.hpp"

#include "castor/mapping/body/seen_obstacles.hpp"
#include "castor/mapping/body/simulated_body.hpp"
#include "castor/mapping/movement/mover_watch.hpp"
#include "castor/mapping/movement/person_follower.hpp"
#include "castor/tests/mapping/movement/footprint_world.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

namespace castor::mapping {

namespace {

using testing::HasSubstr;

struct Drive {
  GoalPursuit::Step last;
  BodyStatus body;
  int recoveries = 0;
  double waited = 0;
};

/// Pursues a goal with a simulated body in `world`, of which the robot knows `map`.
Drive drive(const CellMap& world, const CellMap& map, const Pose2& start, const Point2& goal,
            std::optional<double> heading, double seconds, const std::vector<Walker>& people = {},
            const PursuitOptions& pursuit_options = {}) {
  BodyOptions body_options;
  body_options.people = true;
  BodySurroundings surroundings{test::obstacles_of(world), test::obstacles_of(world), start,
                                people};
  SimulatedBody body(std::move(surroundings), body_options);
  auto options = pursuit_options;
  options.follow.look_ahead = 0.3;
  GoalPursuit pursuit(goal, heading, options);
  PlanningMap planning_map(options.plan.cells);
  planning_map.update(map, 1);
  SeenObstacles seen;
  MoverWatch watch;
  Drive result;
  while (body.time().count() < static_cast<std::int64_t>(seconds * 1e6)) {
    body.step();
    if (body.steps() % 2 == 0)
      watch.add(body.odometry());
    if (body.steps() % 10 == 0) {
      const auto scan = body.scan();
      seen.add(scan, body.status().pose);
      watch.add(scan);
    }
    if (body.steps() % 5 != 0)
      continue;
    const auto robot = body.status().pose;
    const auto points = seen.points();
    const auto movers = watch.movers(robot);
    result.last = pursuit.step(body.time().count(), robot, {planning_map, points, movers});
    body.command(result.last.velocity);
    if (result.last.status == MovementStatus::arrived ||
        result.last.status == MovementStatus::failed)
      break;
  }
  result.body = body.status();
  result.recoveries = pursuit.recoveries();
  result.waited = static_cast<double>(pursuit.waited()) / 1e6;
  return result;
}

TEST(GoalPursuit, ReachesAGoalThroughADoorAndFacesWhereItShould) {
  auto map = test::empty_room(6, 4);
  test::fill(map, 2.95, 0, 3.05, 4);
  test::fill(map, 2.95, 1.6, 3.05, 2.4, 0);
  const auto x = drive(map, map, {1, 1, 3}, {5, 3}, -1.5, 60);
  EXPECT_EQ(x.last.status, MovementStatus::arrived) << x.last.reason;
  EXPECT_LT(distance(Point2{x.body.pose.x, x.body.pose.y}, Point2{5, 3}), 0.15);
  EXPECT_NEAR(x.body.pose.heading, -1.5, 0.1);
  EXPECT_EQ(x.body.collisions, 0);
}

/// Those of a robot that passes people.
PursuitOptions that_passes() {
  return pursuit_behind_person({});
}

/// Along y = 3.
CellMap corridor(double length, double width) {
  auto result = test::empty_room(length, 6);
  test::fill(result, 0, 0, length, 3 - width / 2);
  test::fill(result, 0, 3 + width / 2, length, 6);
  return result;
}

TEST(GoalPursuit, GoesAroundWhatTheMapDoesNotHave) {
  const auto map = test::empty_room(6, 4);
  auto world = map;
  test::fill(world, 2.7, 1.5, 3.3, 2.5);
  const auto x = drive(world, map, {1, 2, 0}, {5, 2}, {}, 60);
  EXPECT_EQ(x.last.status, MovementStatus::arrived) << x.last.reason;
  EXPECT_EQ(x.body.collisions, 0);
}

TEST(GoalPursuit, GivesUpWhereSomebodyIsInItsWayForever) {
  const auto map = test::empty_room(8, 6);
  PlanningMap planning_map;
  planning_map.update(map, 1);
  GoalPursuit pursuit({6, 3}, std::nullopt, {});
  const std::vector<Mover> crowd{{{2.2, 3}, {-0.5, 0}}};
  GoalPursuit::Step step;
  std::int64_t time = 0;
  for (; time < 400'000'000 && step.status != MovementStatus::failed; time += 50'000) {
    step = pursuit.step(time, {1, 3, 0}, {planning_map, {}, crowd});
    if (step.status == MovementStatus::waiting) {
      EXPECT_EQ(step.waits_for, "somebody to pass");
    }
  }
  EXPECT_EQ(step.status, MovementStatus::failed);
  EXPECT_THAT(step.reason, HasSubstr("not come nearer for 300 s"));
  EXPECT_NEAR(static_cast<double>(time) / 1e6, 300, 1);
}

TEST(GoalPursuit, GoesToAGoalThatChanges) {
  const auto map = test::empty_room(8, 6);
  PlanningMap planning_map;
  planning_map.update(map, 1);
  GoalPursuit pursuit({6, 1}, std::nullopt, {});
  Pose2 robot{1, 1, 0};
  GoalPursuit::Step step;
  for (int i = 0; i < 1200 && step.status != MovementStatus::arrived; ++i) {
    constexpr std::int64_t period = 50'000;
    step = pursuit.step(i * period, robot, {planning_map, {}});
    robot = moved(robot, step.velocity, 0.05);
    if (robot.x > 3)
      pursuit.change_goal({2, 5});
  }
  EXPECT_EQ(step.status, MovementStatus::arrived);
  EXPECT_NEAR(distance(Point2{2, 5}, {robot.x, robot.y}), 0, 0.15);
}

TEST(GoalPursuit, ARobotThatIsHeldIsNotStalled) {
  const auto map = test::empty_room(8, 6);
  PlanningMap planning_map;
  planning_map.update(map, 1);
  GoalPursuit pursuit({6, 1}, std::nullopt, {});
  const Pose2 robot{1, 1, 0};
  constexpr std::int64_t second = 1'000'000;
  pursuit.step(0, robot, {planning_map, {}});
  for (int i = 1; i < 10; ++i)
    pursuit.hold(i * second, robot);
  EXPECT_EQ(pursuit.step(10 * second, robot, {planning_map, {}}).status, MovementStatus::moving);
  EXPECT_EQ(pursuit.recoveries(), 0);
}

TEST(GoalPursuit, GivesUpWhereADoorIsShutThatTheMapHasOpen) {
  auto map = test::empty_room(6, 4);
  test::fill(map, 2.95, 0, 3.05, 4);
  auto world = map;
  test::fill(map, 2.95, 1.6, 3.05, 2.4, 0);
  const auto x = drive(world, map, {1, 2, 0}, {5, 2}, {}, 120);
  EXPECT_EQ(x.last.status, MovementStatus::failed) << x.last.waits_for;
  EXPECT_THAT(x.last.reason, HasSubstr("not on the map blocks every way"));
  EXPECT_EQ(x.body.collisions, 0);
}

TEST(GoalPursuit, SaysAtOnceThatAGoalCannotBeReached) {
  auto map = test::empty_room(6, 4);
  test::fill(map, 2.95, 0, 3.05, 4);
  const auto x = drive(map, map, {1, 2, 0}, {5, 2}, {}, 10);
  EXPECT_EQ(x.last.status, MovementStatus::failed);
  EXPECT_THAT(x.last.reason, HasSubstr("no way"));
  EXPECT_LT(x.body.time, 200'000);
}

TEST(GoalPursuit, DoesNotRunIntoPeopleWhoCrossItsWay) {
  const auto map = test::empty_room(8, 5);
  Walker up;
  up.route = {{3, 1}, {3, 4}};
  Walker down;
  down.route = {{5, 4}, {5, 1}};
  const auto x = drive(map, map, {1, 2.5, 0}, {7, 2.5}, {}, 90, {up, down});
  EXPECT_EQ(x.last.status, MovementStatus::arrived) << x.last.reason;
  EXPECT_EQ(x.body.collisions, 0);
}

TEST(GoalPursuit, PassesWhoComesTowardsItInACorridorAndHardlyStands) {
  const auto map = corridor(14, 2.6);
  Walker comes;
  comes.route = {{13, 3}, {0.5, 3}};
  const auto x = drive(map, map, {1, 3, 0}, {10, 3}, {}, 60, {comes}, that_passes());
  EXPECT_EQ(x.last.status, MovementStatus::arrived) << x.last.reason;
  EXPECT_EQ(x.body.collisions, 0);
  EXPECT_LT(x.waited, 1);
}

TEST(GoalPursuit, MakesRoomForWhoWaitsBeforeItAndGoesOnWaiting) {
  const auto map = corridor(8, 0.8);
  PlanningMap planning_map;
  planning_map.update(map, 1);
  GoalPursuit pursuit({7, 3}, std::nullopt, that_passes());
  Pose2 robot{1, 3, 0};
  const std::vector<Mover> walker{{{3.2, 3}, {-0.3, 0}}};
  constexpr std::int64_t period = 50'000;
  double farthest = 0;
  for (int i = 0; i < 1200; ++i) {
    const auto step = pursuit.step(i * period, robot, {planning_map, {}, walker});
    ASSERT_NE(step.status, MovementStatus::failed) << step.reason;
    robot = moved(robot, step.velocity, 0.05);
    farthest = std::max(farthest, robot.x);
  }
  EXPECT_GT(pursuit.recoveries(), 0);
  EXPECT_LT(farthest, 3.2 - 0.55);
}

TEST(GoalPursuit, WaitsForWhoStandsInTheWayToANewGoalBeforeItGoesALongWayAround) {
  // A corridor around a block; the goal moves as somebody does who is followed.
  auto map = test::empty_room(20, 12);
  test::fill(map, 2, 1.5, 18, 10);
  PlanningMap planning_map;
  planning_map.update(map, 1);
  GoalPursuit pursuit({9, 0.75}, std::nullopt, that_passes());
  const Pose2 robot{4, 0.75, 0};
  const std::vector<Mover> stands{{{6, 0.75}, {}}};
  const auto step = pursuit.step(0, robot, {planning_map, {}, stands});
  EXPECT_EQ(step.waits_for, "a free way");
  pursuit.change_goal({10, 0.75});
  EXPECT_EQ(pursuit.step(1'000'000, robot, {planning_map, {}, stands}).waits_for, "a free way");
  EXPECT_EQ(pursuit.step(7'000'000, robot, {planning_map, {}, stands}).status,
            MovementStatus::moving);
}

} // namespace

} // namespace castor::mapping
