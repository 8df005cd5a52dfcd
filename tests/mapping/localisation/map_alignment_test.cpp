#include "castor/mapping/localisation/map_alignment.hpp"

#include "castor/benchmarks/localisation/wandering_robot.hpp"
#include "castor/tests/mapping/localisation/room_maps.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace castor::mapping::test {

namespace {

TEST(MapAlignment, BeamsThatDidNotComeBackHaveNoEnd) {
  LaserScan scan;
  scan.mount = {1, 0, 0};
  scan.angle_step = 1.5707963267948966;
  scan.max_range = 5;
  scan.ranges = {2, 3, 0, 5};
  auto ends = ends_of_beams(scan, 10);
  ASSERT_EQ(ends.size(), 2U);
  EXPECT_NEAR(ends[0].x, 3, 1e-6);
  EXPECT_NEAR(ends[1].x, 1, 1e-6);
  EXPECT_NEAR(ends[1].y, 3, 1e-6);
  EXPECT_EQ(ends_of_beams(scan, 2).size(), 1U);
}

TEST(MapAlignment, FindsThePoseFromAGuessNearby) {
  const auto map = furnished_map();
  DistanceField field{map};
  localisation_benchmark::WanderingRobot robot{map, {1.5, 2, 0.3}};
  auto points = ends_of_beams(robot.scan(), 90);
  MapAlignmentOptions options;
  options.prior = 0.5;
  options.prior_heading = 0.3;
  auto truth = robot.truth();
  for (double dx : {-0.25, 0.25})
    for (double turn : {-0.1, 0.1}) {
      auto pose =
        aligned(field, points, {truth.x + dx, truth.y - dx, truth.heading + turn}, options);
      EXPECT_LT(distance(pose, truth), 0.06) << dx << " " << turn;
      EXPECT_LT(std::abs(normalised(pose.heading - truth.heading)), 0.02) << dx << " " << turn;
    }
}

TEST(MapAlignment, WithoutPointsItIsTheGuess) {
  DistanceField field{furnished_map()};
  EXPECT_EQ(aligned(field, {}, {1, 2, 3}), (Pose2{1, 2, 3}));
}

TEST(MapAlignment, AcrossACorridorOnlyThePositionAcrossItIsCorrected) {
  CellMap map;
  map.columns = 400;
  map.rows = 40;
  map.cells.assign(400 * 40, 0);
  for (int column = 0; column < 400; ++column)
    map.at(column, 0) = map.at(column, 39) = 100;
  DistanceField field{map};
  std::vector<Point2> walls;
  for (double x = -3; x <= 3; x += 0.2) {
    walls.push_back({x, 0.95});
    walls.push_back({x, -0.95});
  }
  auto pose = aligned(field, walls, {10, 1.1, 0});
  EXPECT_NEAR(pose.x, 10, 1e-3);
  EXPECT_NEAR(pose.y, 1, 0.02);
}

} // namespace

} // namespace castor::mapping::test
