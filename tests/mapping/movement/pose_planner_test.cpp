#include "castor/mapping/movement/pose_planner.hpp"

#include "castor/mapping/movement/path_planner.hpp"
#include "castor/tests/mapping/movement/footprint_world.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <optional>

namespace castor::mapping {

namespace {

using testing::HasSubstr;

PlannedPosePath plan(const CellMap& map, const Footprint& footprint, const Pose2& start,
                     const Point2& goal, std::optional<double> heading,
                     const PosePlanOptions& options = {}) {
  return plan_poses(map, ClearanceMap(map), footprint, start, goal, heading, options);
}

/// Of a car of 0.7 m.
PosePlanOptions of_car() {
  PosePlanOptions result;
  result.steering = PoseSteering::reeds_shepp;
  result.turning_radius = 0.6;
  return result;
}

void expect_end(const PosePath& path, const Pose2& end) {
  const auto last = begins_of(path).back();
  EXPECT_NEAR(distance(last, end), 0, 1e-3);
  EXPECT_NEAR(normalised(last.heading - end.heading), 0, 1e-3);
}

} // namespace

TEST(PosePath, KnowsItsLengthAndItsGears) {
  const PosePath path{{1, 1, 0}, {{2, 0}, {0, 1}, {-1, 0.5}, {-0.5, 0}, {1, 0}}};
  EXPECT_DOUBLE_EQ(length(path), 4.5);
  EXPECT_EQ(gear_changes(path), 2);
  EXPECT_DOUBLE_EQ(begins_of(path)[1].x, 3);
}

// The room of a disc as wide as the robot is long does not lead through this door.
TEST(PosePlanner, LongRobotPassesADoorTurned) {
  const auto map = test::two_rooms(0.75);
  const auto robot = test::long_robot();
  PlanOptions disc;
  disc.radius = robot.outer_radius();
  EXPECT_TRUE(plan_path(map, ClearanceMap(map), {1, 1}, {5, 3}, disc).points.empty());
  const Pose2 end{5, 3, std::numbers::pi / 2};
  for (unsigned seed = 1; seed <= 10; ++seed) {
    PosePlanOptions options;
    options.seed = seed;
    const auto x = plan(map, robot, {1, 1, std::numbers::pi / 2}, {5, 3}, end.heading, options);
    ASSERT_FALSE(x.path.empty()) << "seed " << seed << ": " << x.reason;
    expect_end(x.path, end);
    EXPECT_GT(test::least_gap(map, robot, x.path), 0.03) << "seed " << seed;
    EXPECT_LT(length(x.path), 8) << "seed " << seed;
  }
}

TEST(PosePlanner, RefusesADoorThatIsNarrowerThanTheRobot) {
  const auto x = plan(test::two_rooms(0.5), test::long_robot(), {1, 1, 0}, {5, 3}, {});
  EXPECT_TRUE(x.path.empty());
  EXPECT_TRUE(x.is_proved);
  EXPECT_THAT(x.reason, HasSubstr("no way: the passage at"));
}

TEST(PosePlanner, RefusesAGoalWhereTheFootprintDoesNotFit) {
  const auto map = test::empty_room(6, 4);
  // Beside a wall: along it the robot fits, across it does not.
  EXPECT_THAT(plan(map, test::long_robot(), {1, 2, 0}, {0.55, 2}, 0).reason,
              HasSubstr("does not fit at the goal as it is to face there"));
  const auto along = plan(map, test::long_robot(), {2, 2, 0}, {0.55, 2}, {});
  ASSERT_FALSE(along.path.empty()) << along.reason;
  EXPECT_NEAR(std::abs(std::sin(begins_of(along.path).back().heading)), 1, 0.3);
}

TEST(PosePlanner, StartOnAnObstacleIsSaid) {
  const auto x = plan(test::two_rooms(1), test::long_robot(), {0.3, 2, 0}, {5, 3}, {});
  EXPECT_TRUE(x.path.empty());
  EXPECT_THAT(x.reason, HasSubstr("footprint touches an obstacle"));
}

TEST(PosePlanner, StartWithLessRoomThanTheMarginIsLeft) {
  const auto map = test::empty_room(6, 4);
  // 2 cm from the wall.
  const auto x = plan(map, test::long_robot(), {0.68, 2, 0}, {4, 2}, 0.0);
  EXPECT_FALSE(x.path.empty()) << x.reason;
}

// A lane as wide as two cars: to face the other way it has to go to and fro.
TEST(PosePlanner, CarShuntsToTurnRound) {
  const auto map = test::empty_room(6, 1.6);
  const Pose2 end{2.5, 0.8, std::numbers::pi};
  for (unsigned seed = 1; seed <= 10; ++seed) {
    auto options = of_car();
    options.seed = seed;
    const auto x = plan(map, test::car(), {2.5, 0.8, 0}, {end.x, end.y}, end.heading, options);
    ASSERT_FALSE(x.path.empty()) << "seed " << seed << ": " << x.reason;
    expect_end(x.path, end);
    EXPECT_GE(gear_changes(x.path), 2) << "seed " << seed;
    EXPECT_GT(test::least_gap(map, test::car(), x.path), 0.03) << "seed " << seed;
    for (const auto& motion : x.path.motions) {
      EXPECT_NE(motion.forward, 0) << "a car does not turn on the spot";
      EXPECT_LE(std::abs(motion.turn), std::abs(motion.forward) / options.turning_radius + 1e-9);
    }
  }
}

TEST(PosePlanner, CarGoesThroughADoor) {
  const auto map = test::two_rooms(0.8);
  for (unsigned seed = 1; seed <= 10; ++seed) {
    auto options = of_car();
    options.seed = seed;
    const auto x = plan(map, test::car(), {1, 1, std::numbers::pi}, {5, 3}, {}, options);
    ASSERT_FALSE(x.path.empty()) << "seed " << seed << ": " << x.reason;
    EXPECT_GT(test::least_gap(map, test::car(), x.path), 0.03) << "seed " << seed;
  }
}

TEST(PosePlanner, FindsTheSameWithTheSameSeed) {
  const auto map = test::two_rooms(0.8);
  const auto once = plan(map, test::long_robot(), {1, 1, 0}, {5, 3}, 0.0);
  const auto again = plan(map, test::long_robot(), {1, 1, 0}, {5, 3}, 0.0);
  ASSERT_FALSE(once.path.empty());
  EXPECT_EQ(once.path.motions, again.path.motions);
}

} // namespace castor::mapping
