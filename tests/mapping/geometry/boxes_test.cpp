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

TEST(Boxes, AreRefinedWhenTheirHeightIsAnother) {
  auto high = [](double height) {
    auto x = box(0.01, 0);
    x.size.z = height;
    return x;
  };
  EXPECT_TRUE(is_refined(high(0), high(0.1)));
  EXPECT_TRUE(is_refined(high(0.1), high(0)));
  EXPECT_FALSE(is_refined(high(0), high(0)));
  EXPECT_TRUE(is_refined(high(0.0991), high(0.0906)));
  EXPECT_FALSE(is_refined(high(0.1), high(0.096)));
  auto half_hidden = high(0.1);
  half_hidden.size.x = 0.05;
  EXPECT_FALSE(is_refined(high(0.1), half_hidden));
}

} // namespace castor::geometry::test
