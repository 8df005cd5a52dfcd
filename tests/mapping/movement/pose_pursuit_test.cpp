// Robots whose footprint is no disc, driven by PosePursuit with a simulated body.

#include "castor/mapping/movement/pose_pursuit.hpp"

#include "castor/mapping/body/seen_obstacles.hpp"
#include "castor/mapping/body/simulated_body.hpp"
#include "castor/tests/mapping/movement/footprint_world.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <numbers>
#include <optional>
#include <utility>

namespace castor::mapping {

namespace {

using testing::HasSubstr;

struct PoseDrive {
  Pursuit::Step last;
  BodyStatus body;
  int recoveries = 0;
};

PosePursuitOptions options_of(const Footprint& footprint, double turning_radius) {
  PosePursuitOptions result{footprint, {}, {}, {}};
  if (turning_radius > 0) {
    result.plan.steering = PoseSteering::reeds_shepp;
    // Tighter than planned it can steer back to its path.
    result.plan.turning_radius = 1.2 * turning_radius;
    result.follow.turning_radius = turning_radius;
  }
  return result;
}

/// Pursues a goal with a simulated body in `world`, of which the robot knows `map`.
PoseDrive drive(const CellMap& world, const CellMap& map, const Footprint& footprint,
            double turning_radius, const Pose2& start, const Pose2& goal, double seconds,
            std::uint64_t seed = 1) {
  BodyOptions body_options;
  body_options.seed = seed;
  body_options.footprint = footprint;
  body_options.drive.turning_radius = turning_radius;
  SimulatedBody body({test::obstacles_of(world), test::obstacles_of(world), start, {}},
                     body_options);
  auto options = options_of(footprint, turning_radius);
  options.plan.seed = static_cast<std::uint32_t>(seed);
  PosePursuit pursuit({goal.x, goal.y}, goal.heading, options);
  PlanningMap planning_map(options.plan.cells);
  planning_map.update(map, 1);
  SeenObstacles seen;
  PoseDrive result;
  while (body.time().count() < static_cast<std::int64_t>(seconds * 1e6)) {
    body.step();
    const auto robot = body.status().pose;
    if (body.steps() % 10 == 0)
      seen.add(body.scan(), robot);
    if (body.steps() % 5 != 0)
      continue;
    const auto points = seen.points();
    result.last = pursuit.step(body.time().count(), robot, {planning_map, points});
    body.command(result.last.velocity);
    if (result.last.status == MovementStatus::arrived ||
        result.last.status == MovementStatus::failed)
      break;
  }
  result.body = body.status();
  result.recoveries = pursuit.recoveries();
  return result;
}

void expect_arrival(const PoseDrive& x, const Pose2& goal, std::uint64_t seed) {
  EXPECT_EQ(x.last.status, MovementStatus::arrived)
    << "seed " << seed << ": " << x.last.reason << " at " << x.body.pose.x << " " << x.body.pose.y;
  EXPECT_LT(distance(x.body.pose, goal), 0.12) << "seed " << seed;
  EXPECT_NEAR(normalised(x.body.pose.heading - goal.heading), 0, 0.2) << "seed " << seed;
  EXPECT_EQ(x.body.collisions, 0) << "seed " << seed;
}

} // namespace

TEST(PosePursuit, LongRobotDrivesThroughADoor) {
  const auto map = test::two_rooms(0.75);
  const Pose2 goal{5, 3, std::numbers::pi / 2};
  for (std::uint64_t seed = 1; seed <= 3; ++seed)
    expect_arrival(
      drive(map, map, test::long_robot(), 0, {1, 1, std::numbers::pi / 2}, goal, 120, seed), goal,
      seed);
}

TEST(PosePursuit, CarDrivesThroughADoor) {
  const auto map = test::two_rooms(0.8);
  const Pose2 goal{5, 3, 0};
  for (std::uint64_t seed = 1; seed <= 3; ++seed)
    expect_arrival(drive(map, map, test::car(), 0.5, {1, 1, std::numbers::pi}, goal, 120, seed),
                   goal, seed);
}

TEST(PosePursuit, CarShuntsInALane) {
  const auto map = test::empty_room(6, 1.6);
  const Pose2 goal{2.5, 0.8, std::numbers::pi};
  for (std::uint64_t seed = 1; seed <= 3; ++seed)
    expect_arrival(drive(map, map, test::car(), 0.5, {2.5, 0.8, 0}, goal, 180, seed), goal, seed);
}

TEST(PosePursuit, GoesAroundWhatTheMapDoesNotHave) {
  const auto map = test::empty_room(8, 5);
  auto world = map;
  test::fill(world, 3.7, 2, 4.2, 3);
  const Pose2 goal{6.5, 2.5, 0};
  expect_arrival(drive(world, map, test::long_robot(), 0, {1, 2.5, 0}, goal, 120), goal, 1);
}

TEST(PosePursuit, GivesUpBeforeADoorThatIsBlocked) {
  const auto map = test::two_rooms(0.75);
  auto world = map;
  test::fill(world, 3.3, 1.8, 3.5, 2.2);
  const auto x = drive(world, map, test::long_robot(), 0, {1.2, 2, 0}, {5, 2, 0}, 200);
  EXPECT_EQ(x.last.status, MovementStatus::failed);
  EXPECT_FALSE(x.last.reason.empty());
  EXPECT_EQ(x.body.collisions, 0);
}

// What would be a collision is one: the footprint is judged, not a disc.
TEST(PosePursuit, SimulatedFootprintCollides) {
  const auto map = test::empty_room(4, 1.2);
  BodyOptions options;
  options.footprint = test::long_robot();
  SimulatedBody body({test::obstacles_of(map), test::obstacles_of(map), {2, 0.6, 0}, {}}, options);
  body.command({0, 1});
  for (int i = 0; i < 300; ++i)
    body.step();
  EXPECT_EQ(body.status().collisions, 1);
  EXPECT_GT(body.status().pose.heading, 0.1);
  EXPECT_LT(body.status().pose.heading, 1);
  body.command({0, -1});
  for (int i = 0; i < 20; ++i)
    body.step();
  EXPECT_EQ(body.status().collisions, 1) << "it turns away";
  EXPECT_LT(body.status().velocity.turn, 0);
}

TEST(PosePursuit, SimulatedCarDoesNotTurnOnTheSpot) {
  const auto map = test::empty_room(6, 6);
  BodyOptions options;
  options.drive.turning_radius = 0.5;
  SimulatedBody body({test::obstacles_of(map), test::obstacles_of(map), {3, 3, 0}, {}}, options);
  body.command({0, 1});
  for (int i = 0; i < 100; ++i)
    body.step();
  EXPECT_NEAR(body.status().pose.heading, 0, 1e-6);
  body.command({0.2, 1});
  for (int i = 0; i < 100; ++i)
    body.step();
  EXPECT_NEAR(body.status().velocity.turn, 0.4, 0.1);
}

} // namespace castor::mapping
