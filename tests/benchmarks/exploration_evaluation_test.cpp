// The evaluator of explorations, on hand-made cases, and explorations with an exact laser.

#include "castor/benchmarks/exploration/exact_exploration.hpp"
#include "castor/benchmarks/exploration/exploration_evaluation.hpp"
#include "castor/mapping/building/building_file.hpp"
#include "castor/mapping/building/building_generator.hpp"
#include "castor/mapping/exploration/exploration_planner.hpp"
#include "castor/mapping/planar/poses.hpp"
#include "castor/tests/mapping/exploration/scanned_building.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <numbers>
#include <string>

namespace castor::mapping::test {

namespace {

/// Two rooms of 4 m x 4 m with a door between them.
Building two_rooms() {
  return parse_building("wall 0 0 to 8 0 to 8 4 to 0 4 close\nwall 4 0 to 4 4\n"
                        "door d at 4 2 width 0.9\nroom left at 1 1\nroom right at 6 1\n"
                        "start 1 2 heading 90\n",
                        "two-rooms.building")
    .building;
}

/// All of it free, in cells of 0.05 m, in a frame that begins where the robot does.
CellMap map_up_to(double greatest_x) {
  CellMap result;
  result.columns = result.rows = 200;
  // The robot's x axis is the building's y axis.
  result.origin = {-3, -9, 0};
  result.cells.assign(200 * 200, -1);
  const Pose2 start{1, 2, std::numbers::pi / 2};
  for (int row = 0; row < 200; ++row)
    for (int column = 0; column < 200; ++column) {
      const auto p = transform(start, {-3 + 0.05 * (column + 0.5), -9 + 0.05 * (row + 0.5)});
      if (p.x < greatest_x)
        result.at(column, row) = 10;
    }
  return result;
}

} // namespace

TEST(SeenFloor, IsThatOfTheReachableFloor) {
  const auto building = two_rooms();
  const ReachableFloor floor(building);
  const auto all = seen_floor(building, floor, map_up_to(10), building.start);
  EXPECT_NEAR(all.known, 1, 1e-9);
  EXPECT_NEAR(all.free, 1, 1e-9);
  EXPECT_NEAR(all.free_of_open, 1, 1e-9);
  const auto half = seen_floor(building, floor, map_up_to(4), building.start);
  EXPECT_NEAR(half.known, 0.5, 0.02);
  EXPECT_NEAR(half.free_of_open, 0.5, 0.02);
  const auto none = seen_floor(building, floor, {}, building.start);
  EXPECT_EQ(none.known, 0);
  EXPECT_EQ(none.free_of_open, 0);
}

TEST(SeenFloor, CellsThatHoldAWallNeedNotBeFree) {
  const auto building = two_rooms();
  const ReachableFloor floor(building);
  auto map = map_up_to(10);
  // Everything within a cell of a wall is occupied.
  const auto to_building = compose(building.start, map.origin);
  for (int row = 0; row < map.rows; ++row)
    for (int column = 0; column < map.columns; ++column) {
      const auto p = transform(to_building, {0.05 * (column + 0.5), 0.05 * (row + 0.5)});
      if (p.y < 0.08 || p.y > 3.92)
        map.at(column, row) = 90;
    }
  const auto seen = seen_floor(building, floor, map, building.start);
  EXPECT_NEAR(seen.known, 1, 1e-9);
  EXPECT_LT(seen.free, seen.free_of_open);
  EXPECT_GT(seen.free_of_open, 0.97);
  EXPECT_LT(seen.free, 0.99);
}

TEST(ExactExploration, SeesAllOfTwoRooms) {
  const auto building = two_rooms();
  ExactExplorationOptions options;
  options.plan.cells.unknown_is_obstacle = false;
  const auto x = explore_exactly(building, options);
  EXPECT_TRUE(x.finished);
  EXPECT_GE(seen_floor(building, ReachableFloor(building), x.map, {}).free_of_open, 0.98);
  EXPECT_GT(x.driven, 2) << "the other room is not seen from the start";
  EXPECT_LT(x.driven, 30);
}

TEST(ShortestExploration, IsNoLongerThanTheWayToTheDoorOfTheOtherRoom) {
  const auto building = two_rooms();
  const ReachableFloor floor(building);
  // A far corner of the other room is seen from beside the door at the latest.
  EXPECT_LT(shortest_exploration(building, floor, 12), 3);
  // Who sees no farther than a step has to go to both corners.
  EXPECT_GT(shortest_exploration(building, floor, 0.5), 5);
}

TEST(ExplorationPlanner, SeesGeneratedBuildingsWithAnExactLaser) {
  for (std::uint64_t seed : {1, 2, 3, 4, 5}) {
    const auto building = generate_building({.seed = seed});
    ScannedBuilding scanned(building);
    ExplorationPlanner planner;
    auto robot = building.start;
    for (int i = 0; i < 8; ++i)
      scanned.scan({robot.x, robot.y, robot.heading + i * 0.8});
    int goals = 0;
    // Cells are coarse: some views are a little too near to a wall.
    int outside = 0;
    for (; goals < 300; ++goals) {
      planner.look(cell_map(scanned.grid()), robot);
      const auto next = planner.choose();
      if (!next)
        break;
      outside += scanned.floor().can_be_at(Point2{next->view.x, next->view.y}) ? 0 : 1;
      robot = next->view;
      for (double turn : {-0.8, 0.0, 0.8})
        scanned.scan({robot.x, robot.y, robot.heading + turn});
      planner.arrived(*next);
    }
    EXPECT_LT(goals, 300);
    EXPECT_GE(seen_floor(building, scanned.floor(), cell_map(scanned.grid()), {}).free_of_open,
              0.98)
      << "seed " << seed << ", " << goals << " goals";
    EXPECT_LE(outside, goals / 10) << "seed " << seed;
    RecordProperty("goals_of_seed_" + std::to_string(seed), goals);
  }
}

} // namespace castor::mapping::test
