#include "castor/mapping/geometry/boxes.hpp"

#include <gtest/gtest.h>

namespace castor::geometry::test {

namespace {

AlignedBox box(double x, double y) {
  return {{x, y, 0}, {0.1, 0.1, 0.1}, "table"};
}

} // namespace

TEST(Boxes, HaveMovedByTheirWidthOverTheGround) {
  EXPECT_FALSE(has_moved(box(0, 0), box(0.09, 0)));
  EXPECT_TRUE(has_moved(box(0, 0), box(0.11, 0)));
  EXPECT_TRUE(has_moved(box(0, 0), box(0.08, 0.08)));
  auto lifted = box(0, 0);
  lifted.centroid.z = 1;
  EXPECT_FALSE(has_moved(box(0, 0), lifted));
  auto elsewhere = box(0, 0);
  elsewhere.frame = "map";
  EXPECT_TRUE(has_moved(box(0, 0), elsewhere));
}

TEST(Boxes, HaveMovedWhenTheyTurnOutToBeFlatOrNot) {
  auto flat = box(0, 0);
  flat.size.z = 0;
  EXPECT_TRUE(has_moved(flat, box(0.01, 0)));
  EXPECT_FALSE(has_moved(flat, flat));
  EXPECT_TRUE(has_moved(box(0.01, 0), flat));
}

} // namespace castor::geometry::test
