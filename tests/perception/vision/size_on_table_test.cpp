#include "castor/perception/vision/recognition/size_on_table.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "castor/mapping/geometry/camera_model.hpp"

namespace castor::vision {

using namespace geometry;
namespace {

const Camera table_camera = look_at({0, -0.8, 0.6}, {0, 0, 0}, 40, 640, 480);

/// Where the corners of an upright cylinder are seen.
std::vector<Point2> cylinder_seen(double x, double y, double radius, double height,
                                  const Camera& camera = table_camera) {
  std::vector<Point2> pixels;
  for (int i = 0; i < 48; ++i) {
    const double angle = 2 * std::numbers::pi * i / 48;
    for (const double z : {0.0, height}) {
      const auto pixel =
        project(camera, {x + radius * std::cos(angle), y + radius * std::sin(angle), z});
      if (pixel)
        pixels.push_back(*pixel);
    }
  }
  return pixels;
}

TEST(SizeOnTable, measures_a_flat_piece) {
  const auto box = extent_on_table(table_camera, cylinder_seen(0.1, 0.05, 0.06, 0), true);
  ASSERT_TRUE(box);
  EXPECT_NEAR(box->centroid.x, 0.1, 0.002);
  EXPECT_NEAR(box->centroid.y, 0.05, 0.002);
  EXPECT_NEAR(box->size.x, 0.12, 0.004);
  EXPECT_NEAR(box->size.y, 0.12, 0.004);
  EXPECT_EQ(box->size.z, 0);
}

TEST(SizeOnTable, measures_a_solid_wherever_it_stands) {
  for (const double x : {-0.2, 0.0, 0.15}) {
    for (const double y : {-0.15, 0.0, 0.2}) {
      const auto box = extent_on_table(table_camera, cylinder_seen(x, y, 0.04, 0.09), false);
      ASSERT_TRUE(box);
      EXPECT_NEAR(box->centroid.x, x, 0.015);
      EXPECT_NEAR(box->centroid.y, y, 0.015);
      EXPECT_NEAR(box->size.x, 0.08, 0.01);
      EXPECT_NEAR(box->size.z, 0.09, 0.02);
      EXPECT_NEAR(box->centroid.z, box->size.z / 2, 1e-9);
    }
  }
}

/// From above, what stands at the side is seen leaning sidewards.
TEST(SizeOnTable, MeasuresWhatStandsAtTheSideOfASteepCamera) {
  const Camera steep = look_at({0, -0.34, 0.92}, {0, 0.02, 0}, 38, 640, 480);
  for (const double x : {-0.27, -0.15, 0.0, 0.15, 0.27})
    for (const double y : {-0.2, -0.1, 0.0, 0.1}) {
      const auto box = extent_on_table(steep, cylinder_seen(x, y, 0.027, 0.06, steep), false);
      ASSERT_TRUE(box);
      EXPECT_NEAR(box->centroid.x, x, 0.005) << x << ' ' << y;
      EXPECT_NEAR(box->centroid.y, y, 0.005) << x << ' ' << y;
      EXPECT_NEAR(box->size.x, 0.054, 0.005) << x << ' ' << y;
    }
}

TEST(SizeOnTable, has_no_extent_above_the_horizon) {
  const Camera level = look_at({0, -1, 0.3}, {0, 0, 0.3}, 40, 640, 480);
  const std::vector<Point2> sky{{300, 20}, {340, 20}, {320, 60}};
  EXPECT_FALSE(extent_on_table(level, sky, false));
  EXPECT_FALSE(extent_on_table(level, sky, true));
  EXPECT_FALSE(extent_on_table(table_camera, {}, true));
}

TEST(SizeOnTable, judges_by_the_longest_side) {
  const auto judge = [](double x, double z) {
    return judge_size({{}, {x, x, z}}, false, {.large_from = 0.1});
  };
  EXPECT_EQ(judge(0.05, 0.08).front().value, "small");
  EXPECT_EQ(judge(0.05, 0.2).front().value, "large");
  EXPECT_EQ(judge(0.2, 0).front().value, "large");
  EXPECT_GT(judge(0.2, 0.2).front().confidence, judge(0.12, 0.12).front().confidence);
  EXPECT_NEAR(judge(0.1, 0.1).front().confidence, 0.5, 1e-9);
  EXPECT_NEAR(judge(0.13, 0).front().confidence, 0.9, 1e-6);
  EXPECT_TRUE(judge_size({}, false).empty());
}

TEST(SizeOnTable, IsNeverCertainWithAnAssumedCamera) {
  for (const double side : {0.01, 0.05, 0.2, 1.0, 10.0}) {
    const AlignedBox box{{}, {side, side, side}};
    const auto measured = judge_size(box, false);
    const auto assumed = judge_size(box, true);
    ASSERT_EQ(assumed.size(), 2U);
    EXPECT_EQ(assumed.front().value, measured.front().value) << side;
    EXPECT_GT(measured.front().confidence, 0.9) << side;
    EXPECT_GE(assumed.front().confidence, 0.5) << side;
    EXPECT_LE(assumed.front().confidence, 0.75) << side;
    EXPECT_NEAR(assumed.front().confidence + assumed.back().confidence, 1, 1e-9);
  }
}

} // namespace
} // namespace castor::vision
