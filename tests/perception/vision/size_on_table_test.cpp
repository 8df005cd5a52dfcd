#include "castor/perception/vision/recognition/size_on_table.hpp"

#include <cmath>
#include <numbers>
#include <vector>

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
  const auto box = extent_on_table(table_camera, cylinder_seen(0.1, 0.05, 0.06, 0), "circle");
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
      const auto box = extent_on_table(table_camera, cylinder_seen(x, y, 0.04, 0.09));
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
      const auto box = extent_on_table(steep, cylinder_seen(x, y, 0.027, 0.06, steep));
      ASSERT_TRUE(box);
      EXPECT_NEAR(box->centroid.x, x, 0.005) << x << ' ' << y;
      EXPECT_NEAR(box->centroid.y, y, 0.005) << x << ' ' << y;
      EXPECT_NEAR(box->size.x, 0.054, 0.005) << x << ' ' << y;
    }
}

/// From low to steep; the last is that of the arm. Pixels are small, as they count half here.
const std::vector<Camera> cameras{look_at({0, -1.0, 0.06}, {0, 0, 0.03}, 40, 6400, 4800),
                                  look_at({0, -0.8, 0.3}, {0, 0, 0}, 40, 6400, 4800),
                                  look_at({0, -0.62, 0.55}, {0, 0.03, 0}, 42, 6400, 4800),
                                  look_at({0, -0.34, 0.92}, {0, 0.02, 0}, 38, 6400, 4800)};

TEST(SizeOnTable, MeasuresCylindersFromEveryHeight) {
  for (const auto& camera : cameras)
    for (const double x : {-0.15, 0.0, 0.1})
      for (const double y : {-0.1, 0.0, 0.1})
        for (const double height : {0.05, 0.09}) {
          const auto seen = cylinder_seen(x, y, 0.03, height, camera);
          const auto box = extent_on_table(camera, seen, "cylinder");
          ASSERT_TRUE(box);
          const auto text = testing::Message() << camera.pose.position.z << ": " << x << ' ' << y;
          EXPECT_NEAR(box->centroid.x, x, 0.006) << text;
          EXPECT_NEAR(box->centroid.y, y, 0.006) << text;
          EXPECT_NEAR(box->size.x, 0.06, 0.004) << text;
          EXPECT_NEAR(box->size.z, height, 0.004) << text;
        }
}

/// Where the points of a ball on the table are seen.
std::vector<Point2> ball_seen(double x, double y, double radius, const Camera& camera) {
  std::vector<Point2> pixels;
  for (int i = 0; i < 48; ++i)
    for (int j = 1; j < 48; ++j) {
      const double around = 2 * std::numbers::pi * i / 48;
      const double down = std::numbers::pi * j / 48;
      const auto pixel = project(camera, {x + radius * std::sin(down) * std::cos(around),
                                          y + radius * std::sin(down) * std::sin(around),
                                          radius + radius * std::cos(down)});
      if (pixel)
        pixels.push_back(*pixel);
    }
  return pixels;
}

TEST(SizeOnTable, MeasuresBallsFromEveryHeight) {
  for (const auto& camera : cameras)
    for (const double x : {-0.15, 0.0, 0.1})
      for (const double y : {-0.1, 0.0, 0.1}) {
        const auto box = extent_on_table(camera, ball_seen(x, y, 0.03, camera), "sphere");
        ASSERT_TRUE(box);
        const auto text = testing::Message() << camera.pose.position.z << ": " << x << ' ' << y;
        EXPECT_NEAR(box->centroid.x, x, 0.004) << text;
        EXPECT_NEAR(box->centroid.y, y, 0.004) << text;
        EXPECT_NEAR(box->size.z, 0.06, 0.003) << text;
        EXPECT_NEAR(box->centroid.z, box->size.z / 2, 1e-9) << text;
      }
}

TEST(SizeOnTable, has_no_extent_above_the_horizon) {
  const Camera level = look_at({0, -1, 0.3}, {0, 0, 0.3}, 40, 640, 480);
  const std::vector<Point2> sky{{300, 20}, {340, 20}, {320, 60}};
  EXPECT_FALSE(extent_on_table(level, sky));
  EXPECT_FALSE(extent_on_table(level, sky, "square"));
  EXPECT_FALSE(extent_on_table(table_camera, {}, "square"));
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
