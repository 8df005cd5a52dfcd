// Distances from walls, and the furniture that is left out of them.

#include "castor/mapping/rooms/clearance.hpp"
#include "castor/mapping/rooms/clearance_basins.hpp"
#include "castor/tests/mapping/rooms/drawn_map.hpp"

#include <gtest/gtest.h>

namespace castor::mapping::test {

namespace {

constexpr int free_to = 45;

float at(const Raster<float>& clearance, double x, double y) {
  constexpr double cell_size = 0.05;
  return clearance[clearance.position(static_cast<int>(x / cell_size),
                                      static_cast<int>(y / cell_size))];
}

} // namespace

TEST(Clearance, IsTheDistanceFromTheNearestWallInCells) {
  auto map = DrawnMap(3, 2).free(0.5, 0.5, 2, 1).map();
  auto x = clearance(map, 0, free_to);
  EXPECT_FLOAT_EQ(at(x, 0.52, 0.92), 1);
  EXPECT_FLOAT_EQ(at(x, 1.52, 0.92), 9);
  EXPECT_FLOAT_EQ(at(x, 0.2, 0.2), 0);
}

TEST(Clearance, EdgesOfTheMapAreWalls) {
  auto map = DrawnMap(2, 2).free(0, 0, 2, 2).map();
  EXPECT_FLOAT_EQ(at(clearance(map, 1, free_to), 0.02, 0.52), 1);
}

TEST(Clearance, LeavesOutSmallThingsThatStandByThemselves) {
  auto map = DrawnMap(5, 5).free(0.5, 0.5, 4, 4).occupied(2.3, 2.3, 0.4, 0.4).map();
  EXPECT_FLOAT_EQ(at(clearance(map, 0.5, free_to), 2.52, 2.52), 0);
  EXPECT_GT(at(clearance(map, 0.6, free_to), 2.52, 2.52), 39);
}

TEST(Clearance, KeepsSmallThingsAtWalls) {
  auto map = DrawnMap(5, 5).free(0.5, 0.5, 4, 4).occupied(0.5, 2.3, 0.4, 0.4).map();
  EXPECT_FLOAT_EQ(at(clearance(map, 1, free_to), 0.72, 2.52), 0);
}

TEST(Clearance, UnknownCellsAreNotFree) {
  auto map = DrawnMap(5, 5).free(0.5, 0.5, 4, 4).unknown(3, 0.5, 1.5, 4).map();
  EXPECT_FLOAT_EQ(at(clearance(map, 1, free_to), 3.52, 2.52), 0);
  EXPECT_FLOAT_EQ(at(clearance(map, 1, free_to), 2.97, 2.52), 1);
}

TEST(ClearanceBasins, AreApartWhereTheNeckIsNarrowEnough) {
  // Two rooms of 2 m by 2 m, and an opening of 1.2 m: a ratio of 0.6.
  auto map =
    DrawnMap(5, 3).free(0.4, 0.5, 2, 2).free(2.6, 0.5, 2, 2).free(2.4, 0.9, 0.2, 1.2).map();
  auto clear = clearance(map, 0, free_to);
  EXPECT_EQ(clearance_basins(clear, 0.7).basins.size(), 2U);
  EXPECT_EQ(clearance_basins(clear, 0.5).basins.size(), 1U);
}

TEST(ClearanceBasins, ACorridorWithCornersAndJunctionsIsOne) {
  auto map =
    DrawnMap(12, 8).free(0.5, 0.5, 11, 1.5).free(0.5, 0.5, 1.5, 7).free(6, 0.5, 1.5, 7).map();
  EXPECT_EQ(clearance_basins(clearance(map, 0, free_to), 0.75).basins.size(), 1U);
}

} // namespace castor::mapping::test
