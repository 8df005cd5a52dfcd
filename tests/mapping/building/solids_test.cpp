#include "castor/mapping/building/building_file.hpp"
#include "castor/mapping/building/solid_obstacles.hpp"
#include "castor/mapping/building/solids.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <string>

namespace castor::mapping {

namespace {

using std::numbers::pi;

Building building_with(const std::string& more) {
  auto read = parse_building("wall 0 0 to 8 0 to 8 5 to 0 5 close thickness 0.2\n"
                             "wall 5 0 to 5 5\n"
                             "start 2.5 2.5\n" +
                               more,
                             "");
  EXPECT_FALSE(has_errors(read.problems)) << render(read.problems);
  return read.building;
}

std::optional<double> range(const Building& x, double height, const Point2& from,
                            double direction) {
  return SolidObstacles(between_heights(solids_of(x), height, height)).cast(from, direction, 20);
}

} // namespace

TEST(Solids, WallsHaveThickness) {
  auto x = building_with("");
  EXPECT_NEAR(range(x, 0.3, {2, 2}, 0).value(), 2.95, 1e-9);
  EXPECT_NEAR(range(x, 0.3, {2, 2}, pi).value(), 1.9, 1e-9);
  // From outside, where two walls meet: the corner is filled.
  EXPECT_NEAR(range(x, 0.3, {-2, -0.05}, 0).value(), 1.9, 1e-9);
}

TEST(Solids, OpenDoorsAreOpeningsAndShutOnesAreNot) {
  auto x = building_with("door d at 5 2.5 width 0.8\n");
  EXPECT_NEAR(range(x, 0.3, {2, 2.5}, 0).value(), 5.9, 1e-9);
  EXPECT_NEAR(range(x, 0.3, {2, 2.85}, 0).value(), 5.9, 1e-9) << "beside its middle";
  EXPECT_NEAR(range(x, 0.3, {2, 2.95}, 0).value(), 2.95, 1e-9) << "beside the door";
  EXPECT_NEAR(range(x, 2.2, {2, 2.5}, 0).value(), 2.95, 1e-9) << "above the door";
  x.doors[0].is_open = false;
  EXPECT_NEAR(range(x, 0.3, {2, 2.5}, 0).value(), 2.98, 1e-9);
}

TEST(Solids, SeveralDoorsInAWall) {
  auto x = building_with("door b at 5 4 width 0.8\ndoor a at 5 1 width 1\n");
  for (double y : {0.6, 1.0, 1.4, 3.7, 4.3})
    EXPECT_NEAR(range(x, 0.3, {2, y}, 0).value(), 5.9, 1e-9) << y;
  for (double y : {0.3, 1.6, 2.5, 3.5, 4.5})
    EXPECT_NEAR(range(x, 0.3, {2, y}, 0).value(), 2.95, 1e-9) << y;
}

TEST(Solids, TablesWithLegsAreSeenAtTheirLegs) {
  auto x = building_with("furniture table at 3 3.5 box 1 0.6 0.7 legs\n"
                         "furniture box at 3 1 box 1 0.6 0.7\n");
  EXPECT_NEAR(range(x, 0.3, {1, 1}, 0).value(), 1.5, 1e-9);
  EXPECT_NEAR(range(x, 0.3, {1, 3.5}, 0).value(), 3.95, 1e-9) << "between the legs";
  EXPECT_NEAR(range(x, 0.3, {1, 3.25}, 0).value(), 2 - 0.45 - 0.025, 1e-9);
  EXPECT_NEAR(range(x, 0.68, {1, 3.5}, 0).value(), 1.5, 1e-9) << "the top";
  EXPECT_NEAR(range(x, 0.8, {1, 3.5}, 0).value(), 3.95, 1e-9) << "above it";
}

TEST(Solids, ObjectsStandWhereTheyArePut) {
  auto x = building_with("object vase at 3 3 on 0.5 size 0.2 0.4\n");
  EXPECT_NEAR(range(x, 0.3, {1, 3}, 0).value(), 3.95, 1e-9);
  EXPECT_NEAR(range(x, 0.6, {1, 3}, 0).value(), 1.9, 1e-9);
}

} // namespace castor::mapping
