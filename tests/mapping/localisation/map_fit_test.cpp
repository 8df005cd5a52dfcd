#include "castor/mapping/localisation/map_fit.hpp"

#include <gtest/gtest.h>

#include <memory>

namespace castor::mapping {

namespace {

/// A room of 4 m x 3 m in cells of 0.1 m, from -1 -1, and unknown space of 1 m beside it. A wall
/// stands across the room where x is 1 to 1.1.
CellMap divided_room() {
  CellMap map;
  map.columns = 50;
  map.rows = 30;
  map.cell_size = 0.1;
  map.origin = {-1, -1, 0};
  map.cells.assign(50 * 30, -1);
  for (int row = 0; row < 30; ++row)
    for (int column = 0; column < 40; ++column) {
      auto is_wall = row == 0 || row == 29 || column == 0 || column == 39 || column == 20;
      map.at(column, row) = is_wall ? 100 : 0;
    }
  return map;
}

MapFit fit_of_room() {
  return MapFit{std::make_shared<const DistanceField>(divided_room())};
}

/// Three beams: to the right of the robot, ahead, and to the left.
LaserScan scan(float right, float ahead, float left) {
  LaserScan result;
  result.first_angle = -1.5707963267948966;
  result.angle_step = 1.5707963267948966;
  result.max_range = 10;
  result.ranges = {right, ahead, left};
  return result;
}

TEST(MapFit, BeamsThatEndAtWallsAreExplained) {
  auto fit = fit_of_room();
  EXPECT_DOUBLE_EQ(fit.explained(scan(0.9F, 1, 1.9F), {0, 0, 0}), 1);
  EXPECT_DOUBLE_EQ(fit.explained(scan(0.9F, 0.5F, 1.9F), {0, 0, 0}), 2. / 3);
  EXPECT_DOUBLE_EQ(fit.explained(scan(0.4F, 0.5F, 1), {0, 0, 0}), 0);
}

TEST(MapFit, ABeamThroughAWallIsNot) {
  auto fit = fit_of_room();
  // It ends at the wall on the other side of the one in the middle.
  EXPECT_DOUBLE_EQ(fit.explained(scan(0, 2.9F, 0), {0, 0, 0}), 0);
  EXPECT_DOUBLE_EQ(fit.explained(scan(0, 1.7F, 0), {1.2, 0, 0}), 1);
}

TEST(MapFit, BeamsThatDidNotComeBackDoNotCount) {
  auto fit = fit_of_room();
  EXPECT_DOUBLE_EQ(fit.explained(scan(0.9F, 0, 10), {0, 0, 0}), 1);
  EXPECT_DOUBLE_EQ(fit.explained(scan(0, 0, 0), {0, 0, 0}), 1);
}

TEST(MapFit, OutsideOfTheMapNothingIsExplained) {
  auto fit = fit_of_room();
  EXPECT_DOUBLE_EQ(fit.explained(scan(0.9F, 1, 1.9F), {50, 50, 0}), 0);
}

} // namespace

} // namespace castor::mapping
