// Where a robot is on a map that is a little beside the frame of its poses.

#include "castor/mapping/movement/map_alignment.hpp"

#include "castor/mapping/body/simulated_body.hpp"
#include "castor/mapping/planar/beams.hpp"
#include "castor/tests/mapping/movement/footprint_world.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <vector>

namespace castor::mapping {

namespace {

/// A corridor with a door to the left.
CellMap corridor_with_door() {
  auto map = test::empty_room(10, 5);
  test::fill(map, 0, 1.9, 10, 2);
  test::fill(map, 4.6, 1.9, 5.4, 2, 0);
  return map;
}

PlanningMap planning(const CellMap& map) {
  PlanningMap result;
  result.update(map, 1);
  return result;
}

/// What a laser sees in `world` from `robot`, in the frame in which the robot seems to be at
/// `believed`.
std::vector<Point2> seen_in(const CellMap& world, const Pose2& robot, const Pose2& believed) {
  SimulatedBody body({test::obstacles_of(world), test::obstacles_of(world), robot, {}}, {});
  const auto scan = body.scan();
  std::vector<Point2> result;
  for (std::size_t i = 0; i < scan.ranges.size(); ++i)
    if (scan.ranges[i] > 0 && scan.ranges[i] < 10)
      result.push_back(transform(compose(believed, scan.mount), end_of_beam(scan, i)));
  return result;
}

} // namespace

TEST(MapAlignment, FindsByHowMuchThePoseIsBeside) {
  const auto map = planning(corridor_with_door());
  const Pose2 robot{3, 1, 0};
  for (const Pose2& believed : {Pose2{3.2, 1, 0}, Pose2{2.75, 1.1, 0.03}, Pose2{3, 1.15, -0.06}}) {
    MapAlignment alignment;
    alignment.look(believed, seen_in(corridor_with_door(), robot, believed), {}, map);
    EXPECT_LT(distance(alignment.on_map(believed), robot), 0.08) << believed.x << " " << believed.y;
    EXPECT_NEAR(alignment.on_map(believed).heading, 0, 0.03);
    const Point2 ahead{robot.x + 2, robot.y};
    const auto believed_ahead = transform(compose(believed, inverse(robot)), ahead);
    EXPECT_LT(distance(alignment.on_map(believed, believed_ahead), ahead), 0.12);
  }
}

TEST(MapAlignment, FollowsAPoseThatBecomesRight) {
  const auto map = planning(corridor_with_door());
  const Pose2 robot{3, 1, 0};
  const Pose2 believed{3.25, 1, 0};
  MapAlignment alignment;
  alignment.look(believed, seen_in(corridor_with_door(), robot, believed), {}, map);
  EXPECT_GT(distance(alignment.on_map(robot), robot), 0.15);
  alignment.look(robot, seen_in(corridor_with_door(), robot, robot), {}, map);
  EXPECT_LT(distance(alignment.on_map(robot), robot), 0.08);
}

// A heading that was wrong for a moment is no turn of the whole building.
TEST(MapAlignment, ATurnDoesNotGrowWithTheDistance) {
  const auto map = planning(corridor_with_door());
  const Pose2 robot{3, 1, 0};
  const Pose2 believed{3, 1, 0.09};
  MapAlignment alignment;
  alignment.look(believed, seen_in(corridor_with_door(), robot, believed), {}, map);
  ASSERT_NE(alignment.on_map(believed), believed);
  const Pose2 far{30, 20, 0};
  EXPECT_LT(distance(alignment.on_map(far), far), 0.1);
}

// A cupboard before the door that the map does not have, and somebody who walks.
TEST(MapAlignment, ThingsThatAreNewAreNoReason) {
  const auto map = planning(corridor_with_door());
  const Pose2 robot{3, 1, 0};
  auto world = corridor_with_door();
  test::fill(world, 4.3, 1.6, 4.8, 1.9);
  MapAlignment alignment;
  alignment.look(robot, seen_in(world, robot, robot), {}, map);
  EXPECT_EQ(alignment.on_map(robot), robot);
  world = corridor_with_door();
  test::fill(world, 4.8, 0.7, 5.2, 1.1);
  const std::vector<Mover> movers{{{5, 0.9}, {0.5, 0}}};
  alignment.look(robot, seen_in(world, robot, robot), movers, map);
  EXPECT_EQ(alignment.on_map(robot), robot);
}

// Nothing tells where along the walls it is.
TEST(MapAlignment, DoesNotSlideAlongWalls) {
  const auto walls = test::empty_room(30, 2);
  const auto map = planning(walls);
  const Pose2 robot{15, 1, 0};
  MapAlignment alignment;
  auto world = walls;
  test::fill(world, 17, 0.8, 17.4, 1.2);
  alignment.look(robot, seen_in(world, robot, robot), {}, map);
  EXPECT_EQ(alignment.on_map(robot), robot);
}

TEST(MapAlignment, ElsewhereItKeepsThePose) {
  const auto map = planning(corridor_with_door());
  const Pose2 robot{3, 1, 0};
  const Pose2 believed{3, 3.5, 0.7};
  MapAlignment alignment;
  alignment.look(believed, seen_in(corridor_with_door(), robot, believed), {}, map);
  EXPECT_EQ(alignment.on_map(believed), believed);
}

} // namespace castor::mapping
