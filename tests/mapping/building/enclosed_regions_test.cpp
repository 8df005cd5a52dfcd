#include "castor/mapping/building/enclosed_regions.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

namespace castor::mapping {

namespace {

std::vector<Segment> rectangle(double left, double low, double right, double high) {
  return {{{left, low}, {right, low}},
          {{right, low}, {right, high}},
          {{right, high}, {left, high}},
          {{left, high}, {left, low}}};
}

void add(std::vector<Segment>& walls, const std::vector<Segment>& more) {
  walls.insert(walls.end(), more.begin(), more.end());
}

} // namespace

TEST(EnclosedRegions, SquareIsOneRegion) {
  auto found = enclosed_regions(rectangle(0, 0, 3, 2));
  ASSERT_EQ(found.regions.size(), 1u);
  EXPECT_NEAR(found.regions[0].area, 6, 1e-12);
  EXPECT_GT(signed_area(found.regions[0].outline), 0);
  EXPECT_TRUE(found.free_ends.empty());
}

TEST(EnclosedRegions, OpenWallsEncloseNothing) {
  auto walls = rectangle(0, 0, 3, 2);
  walls.pop_back();
  auto found = enclosed_regions(walls);
  EXPECT_TRUE(found.regions.empty());
  EXPECT_EQ(found.free_ends.size(), 2u);
  EXPECT_FALSE(region_at(found, {1, 1}));
}

TEST(EnclosedRegions, WallsThatCrossDivide) {
  auto walls = rectangle(0, 0, 4, 4);
  walls.push_back({{2, -1}, {2, 5}});
  walls.push_back({{-1, 1}, {5, 1}});
  auto found = enclosed_regions(walls);
  ASSERT_EQ(found.regions.size(), 4u);
  EXPECT_EQ(found.free_ends.size(), 4u);
  EXPECT_NEAR(found.regions[*region_at(found, {1, 0.5})].area, 2, 1e-9);
  EXPECT_NEAR(found.regions[*region_at(found, {3, 3})].area, 6, 1e-9);
}

TEST(EnclosedRegions, BlockWithinIsAHole) {
  auto walls = rectangle(0, 0, 10, 8);
  add(walls, rectangle(2, 2, 8, 6));
  walls.push_back({{5, 2}, {5, 6}});
  // Within the block, one more; and a wall of its own in the corridor.
  add(walls, rectangle(3, 3, 4, 4));
  walls.push_back({{1, 1}, {9, 1}});
  auto found = enclosed_regions(walls);
  ASSERT_EQ(found.regions.size(), 4u);
  auto& corridor = found.regions[*region_at(found, {1, 4})];
  EXPECT_NEAR(corridor.area, 80 - 24, 1e-9);
  EXPECT_EQ(corridor.holes.size(), 1u);
  auto& left = found.regions[*region_at(found, {2.5, 2.5})];
  EXPECT_NEAR(left.area, 12 - 1, 1e-9);
  EXPECT_NEAR(found.regions[*region_at(found, {3.5, 3.5})].area, 1, 1e-9);
}

TEST(EnclosedRegions, EndsThatAreNearMeet) {
  std::vector<Segment> walls{{{0, 0}, {3.99, 0.01}}, {{4, 0}, {4, 3}}, {{4, 3.01}, {0, 0.01}}};
  auto found = enclosed_regions(walls);
  ASSERT_EQ(found.regions.size(), 1u);
  EXPECT_NEAR(found.regions[0].area, 6, 0.1);
}

TEST(EnclosedRegions, WallAlongAWallChangesNothing) {
  auto walls = rectangle(0, 0, 4, 4);
  walls.push_back({{1, 0}, {3, 0}});
  walls.push_back({{4, 0}, {4, 4}});
  auto found = enclosed_regions(walls);
  ASSERT_EQ(found.regions.size(), 1u);
  EXPECT_NEAR(found.regions[0].area, 16, 1e-9);
}

RC_GTEST_PROP(EnclosedRegions, LinesThroughASquareLeaveItsArea, ()) {
  auto walls = rectangle(0, 0, 100, 100);
  const auto count = *rc::gen::inRange(0, 8);
  for (int i = 0; i < count; ++i) {
    // From side to side, through everything in between.
    auto side = [](int which, double at) {
      return which == 0   ? Point2{at, 0}
             : which == 1 ? Point2{100, at}
             : which == 2 ? Point2{at, 100}
                          : Point2{0, at};
    };
    const int a = *rc::gen::inRange(0, 4);
    const int b = (a + *rc::gen::inRange(1, 4)) % 4;
    walls.push_back({side(a, *rc::gen::inRange(1, 100)), side(b, *rc::gen::inRange(1, 100))});
  }
  auto found = enclosed_regions(walls);
  double area = 0;
  for (auto& x : found.regions) {
    RC_ASSERT(x.area > 0);
    area += x.area;
  }
  // Points within the tolerance are one.
  RC_ASSERT(std::abs(area - 10000) < 0.03 * 100 * static_cast<double>(walls.size()));
  RC_ASSERT(found.free_ends.empty());
}

TEST(LabelPoint, IsInTheRoomAndOutsideOfItsBlock) {
  const Polygon outline{{0, 0}, {10, 0}, {10, 8}, {0, 8}};
  const Polygon hole{{2, 2}, {2, 6}, {8, 6}, {8, 2}};
  auto p = label_point(outline, {hole});
  EXPECT_TRUE(contains(outline, p));
  EXPECT_FALSE(contains(hole, p));
}

} // namespace castor::mapping
