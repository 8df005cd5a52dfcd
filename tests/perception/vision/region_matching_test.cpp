#include "castor/perception/vision/segmentation/region_matching.hpp"

#include <gtest/gtest.h>

#include <optional>
#include <vector>

namespace castor::vision {

namespace {

ImageBox box(double x, double y, double width, double height) {
  return {{x, y}, width, height};
}

using Matches = std::vector<std::optional<std::size_t>>;

TEST(RegionMatching, OverlapIsSharedAreaByCoveredArea) {
  EXPECT_DOUBLE_EQ(overlap(box(0, 0, 10, 10), box(0, 0, 10, 10)), 1);
  EXPECT_DOUBLE_EQ(overlap(box(0, 0, 10, 10), box(5, 0, 10, 10)), 50.0 / 150);
  EXPECT_DOUBLE_EQ(overlap(box(0, 0, 10, 10), box(10, 0, 10, 10)), 0);
  EXPECT_DOUBLE_EQ(overlap(box(0, 0, 10, 10), box(30, 30, 10, 10)), 0);
  EXPECT_DOUBLE_EQ(overlap(box(0, 0, 10, 10), box(0, 0, 5, 5)), 0.25);
  EXPECT_DOUBLE_EQ(overlap(box(0, 0, 0, 0), box(0, 0, 0, 0)), 0);
}

TEST(RegionMatching, EachBoxIsUsedOnceTheBestPairsFirst) {
  std::vector<ImageBox> old{box(0, 0, 10, 10), box(100, 0, 10, 10)};
  std::vector<ImageBox> fresh{box(2, 0, 10, 10), box(1, 0, 10, 10), box(101, 0, 10, 10)};
  EXPECT_EQ(match_boxes(fresh, old, 0.5), (Matches{std::nullopt, 0, 1}));
}

TEST(RegionMatching, TooLittleOverlapIsNoMatch) {
  std::vector<ImageBox> old{box(0, 0, 10, 10)};
  std::vector<ImageBox> fresh{box(5, 0, 10, 10)};
  EXPECT_EQ(match_boxes(fresh, old, 0.5), Matches{std::nullopt});
  EXPECT_EQ(match_boxes(fresh, old, 0.3), Matches{0});
  EXPECT_EQ(match_boxes(fresh, {}, 0.3), Matches{std::nullopt});
  EXPECT_TRUE(match_boxes({}, old, 0.3).empty());
}

TEST(RegionMatching, ColoursAreComparedWithinTheMask) {
  ROI a;
  a.region = {2, 1, 3, {10, 20, 30, 250, 250, 250}};
  a.mask = {2, 1, 1, {255, 0}};
  ROI b = a;
  b.region.bytes = {10, 20, 34, 0, 0, 0};
  EXPECT_DOUBLE_EQ(colour_distance(a, b), 4);
  EXPECT_DOUBLE_EQ(colour_distance(a, a), 0);
}

TEST(RegionMatching, LooksAreColourAndSizeWhereverTheyAre) {
  ROI red;
  red.box = box(0, 0, 1, 1);
  red.region = {1, 1, 3, {0, 0, 200}};
  red.mask = {1, 1, 1, {255}};
  auto elsewhere = red;
  elsewhere.box.center = {100, 50};
  elsewhere.region.bytes = {0, 0, 205};
  auto larger = red;
  larger.box = box(0, 0, 2, 2);
  auto blue = red;
  blue.region.bytes = {200, 0, 0};
  std::vector<const ROI*> old{&blue, &larger, &red};
  std::vector<const ROI*> fresh{&elsewhere};
  EXPECT_EQ(match_looks(fresh, old, 10), Matches{2});
  EXPECT_EQ(match_looks(fresh, old, 5), Matches{std::nullopt});
  std::vector<const ROI*> two{&elsewhere, &red};
  EXPECT_EQ(match_looks(two, old, 10), (Matches{std::nullopt, 2}));
}

} // namespace

} // namespace castor::vision
