#include "castor/perception/vision/segmentation/neck.hpp"

#include <algorithm>
#include <functional>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

namespace castor::vision {
namespace {

constexpr int picture_width = 160;

/// The cells that `draw` paints.
std::vector<int> cells_of(const std::function<void(cv::Mat&)>& draw) {
  cv::Mat mask(120, picture_width, CV_8U, cv::Scalar(0));
  draw(mask);
  std::vector<int> cells;
  for (int cell = 0; cell < mask.rows * picture_width; ++cell)
    if (mask.data[cell] != 0)
      cells.push_back(cell);
  return cells;
}

/// The numbers of cells of the parts, in order.
std::vector<std::size_t> parts_of(const std::function<void(cv::Mat&)>& draw) {
  const auto cells = cells_of(draw);
  std::vector<std::size_t> sizes;
  std::vector<int> together;
  for (const auto& part : divide_at_necks(cells, picture_width)) {
    sizes.push_back(part.size());
    together.insert(together.end(), part.begin(), part.end());
  }
  std::sort(together.begin(), together.end());
  EXPECT_EQ(together, cells) << "every cell is in one part";
  std::sort(sizes.begin(), sizes.end());
  return sizes;
}

void disc(cv::Mat& mask, int x, int y, int radius) {
  cv::circle(mask, {x, y}, radius, 255, cv::FILLED);
}

void turned_square(cv::Mat& mask, float x, float y, float side, float degrees) {
  cv::Point2f corners[4];
  cv::RotatedRect({x, y}, {side, side}, degrees).points(corners);
  std::vector<cv::Point> polygon(corners, corners + 4);
  cv::fillConvexPoly(mask, polygon, 255);
}

TEST(Neck, divides_discs_that_touch) {
  const auto parts = parts_of([](cv::Mat& mask) {
    disc(mask, 50, 50, 20);
    disc(mask, 88, 56, 20);
  });
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_NEAR(static_cast<double>(parts[0]), 3.14 * 400, 60);
  EXPECT_NEAR(static_cast<double>(parts[1]), 3.14 * 400, 60);
}

TEST(Neck, divides_things_of_different_shape_and_size) {
  EXPECT_EQ(parts_of([](cv::Mat& mask) {
              disc(mask, 50, 50, 22);
              turned_square(mask, 83, 50, 26, 40);
            }).size(),
            2U);
  EXPECT_EQ(parts_of([](cv::Mat& mask) {
              turned_square(mask, 40, 40, 30, 10);
              turned_square(mask, 68, 62, 30, 30);
            }).size(),
            2U);
}

TEST(Neck, leaves_a_convex_thing_whole) {
  EXPECT_EQ(parts_of([](cv::Mat& mask) { disc(mask, 50, 50, 20); }).size(), 1U);
  EXPECT_EQ(parts_of([](cv::Mat& mask) {
              cv::ellipse(mask, {60, 50}, {40, 12}, 30, 0, 360, 255, cv::FILLED);
            }).size(),
            1U);
  EXPECT_EQ(parts_of([](cv::Mat& mask) { turned_square(mask, 60, 60, 40, 20); }).size(), 1U);
}

TEST(Neck, leaves_a_thing_with_an_inward_corner_whole) {
  // An angle, a mug with its handle, and a crescent.
  EXPECT_EQ(parts_of([](cv::Mat& mask) {
              cv::rectangle(mask, {30, 30, 20, 60}, 255, cv::FILLED);
              cv::rectangle(mask, {30, 70, 60, 20}, 255, cv::FILLED);
            }).size(),
            1U);
  EXPECT_EQ(parts_of([](cv::Mat& mask) {
              cv::rectangle(mask, {30, 30, 40, 50}, 255, cv::FILLED);
              cv::ellipse(mask, {70, 52}, {12, 14}, 0, -90, 90, 255, 5);
            }).size(),
            1U);
  EXPECT_EQ(parts_of([](cv::Mat& mask) {
              disc(mask, 60, 60, 30);
              cv::circle(mask, {75, 60}, 25, 0, cv::FILLED);
            }).size(),
            1U);
}

TEST(Neck, leaves_a_rough_outline_whole) {
  EXPECT_EQ(parts_of([](cv::Mat& mask) {
              cv::RNG random(3);
              for (int i = 0; i < 60; ++i)
                disc(mask, random.uniform(40, 90), random.uniform(40, 80), 6);
            }).size(),
            1U);
}

TEST(Neck, leaves_small_areas_whole) {
  EXPECT_EQ(parts_of([](cv::Mat& mask) {
              disc(mask, 50, 50, 3);
              disc(mask, 56, 50, 3);
            }).size(),
            1U);
}

} // namespace
} // namespace castor::vision
