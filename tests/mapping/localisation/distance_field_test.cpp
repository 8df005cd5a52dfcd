#include "castor/mapping/localisation/distance_field.hpp"

#include <gtest/gtest.h>

namespace castor::mapping {

namespace {

/// 20 x 10 cells of 0.1 m from -1 2: free, the column in the middle (x from 0 to 0.1) occupied, the
/// uppermost row unknown.
CellMap divided_field() {
  CellMap map;
  map.columns = 20;
  map.rows = 10;
  map.cell_size = 0.1;
  map.origin = {-1, 2, 0};
  map.cells.assign(200, 0);
  for (int row = 0; row < 10; ++row)
    map.at(10, row) = 100;
  for (int column = 0; column < 20; ++column)
    map.at(column, 9) = -1;
  return map;
}

TEST(DistanceField, IsZeroInOccupiedCellsAndGrowsFromThem) {
  DistanceField field{divided_field()};
  EXPECT_FLOAT_EQ(field.to_occupied(0.05, 2.55), 0);
  EXPECT_FLOAT_EQ(field.to_occupied(0.15, 2.55), 0.1F);
  EXPECT_FLOAT_EQ(field.to_occupied(-0.45, 2.55), 0.5F);
}

TEST(DistanceField, IsLargeOutsideOfTheMap) {
  DistanceField field{divided_field()};
  EXPECT_GT(field.to_occupied(-1.01, 2.5), 100);
  EXPECT_GT(field.to_occupied(0, 3.01), 100);
  EXPECT_FALSE(field.slope(-1.01, 2.5));
  EXPECT_FALSE(field.slope(0.99, 2.5));
}

TEST(DistanceField, SlopeIsThatBetweenTheMiddlesOfCells) {
  DistanceField field{divided_field()};
  auto right = field.slope(0.5, 2.5);
  ASSERT_TRUE(right);
  EXPECT_NEAR(right->distance, 0.45, 1e-6);
  EXPECT_NEAR(right->dx, 1, 1e-6);
  EXPECT_NEAR(right->dy, 0, 1e-6);
  auto left = field.slope(-0.5, 2.5);
  ASSERT_TRUE(left);
  EXPECT_NEAR(left->distance, 0.55, 1e-6);
  EXPECT_NEAR(left->dx, -1, 1e-6);
}

TEST(DistanceField, WithinAWallTheSurfaceIsSomewhereElse) {
  auto map = divided_field();
  for (int row = 0; row < 10; ++row)
    for (int column = 10; column < 15; ++column)
      map.at(column, row) = 100;
  DistanceField field{map};
  EXPECT_FLOAT_EQ(field.to_occupied(0.25, 2.55), 0);
  EXPECT_FLOAT_EQ(field.to_surface(0.25, 2.55), 0.2F);
  EXPECT_FLOAT_EQ(field.to_surface(0.05, 2.55), 0);
  EXPECT_FLOAT_EQ(field.to_surface(-0.05, 2.55), 0.1F);
}

TEST(DistanceField, AMapInWhichNothingCanBeSeenStaysAsItIs) {
  CellMap map;
  map.columns = map.rows = 3;
  map.cells.assign(9, 100);
  EXPECT_EQ(visible_surfaces(map, 65), map);
  map.at(0, 0) = 0;
  EXPECT_EQ(visible_surfaces(map, 65).at(1, 1), 100);
  EXPECT_EQ(visible_surfaces(map, 65).at(2, 2), -1);
}

TEST(DistanceField, UnknownCellsAreNotFree) {
  DistanceField field{divided_field()};
  EXPECT_NEAR(field.free_area(), 19 * 9 * 0.01, 1e-9);
  auto places = field.free_places(0.3, 0.25);
  ASSERT_FALSE(places.empty());
  for (const auto& x : places) {
    EXPECT_LT(x.y, 2.9);
    EXPECT_GE(field.to_occupied(x.x, x.y), 0.25F);
  }
}

} // namespace

} // namespace castor::mapping
