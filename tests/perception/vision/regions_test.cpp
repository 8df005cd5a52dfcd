#include "castor/perception/vision/recognition/regions.hpp"

#include <algorithm>
#include <iterator>
#include <string>
#include <utility>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "castor/mapping/geometry/camera_model.hpp"
#include "castor/perception/vision/opencv_bridge.hpp"
#include "castor/perception/vision/tabletop/tabletop_renderer.hpp"

namespace castor::vision {

using namespace geometry;
namespace {

TabletopObject thing(TabletopShape shape, const SceneColour& colour, double x, double y,
                     double side) {
  TabletopObject object;
  object.shape = shape;
  object.colour = colour;
  object.x = x;
  object.y = y;
  object.size = {side, side, is_flat(shape) ? 0.005 : side};
  object.turned_degrees = 25;
  return object;
}

TEST(Regions, tells_what_is_on_the_table_and_where) {
  TabletopSnapshot scene;
  scene.table.material = TableLook::Material::plain;
  scene.table.colour = {200, 200, 200};
  scene.objects = {thing(TabletopShape::cube, {180, 30, 30}, -0.15, 0.05, 0.14),
                   thing(TabletopShape::sphere, {30, 60, 190}, 0.12, 0.1, 0.06),
                   thing(TabletopShape::triangle, {30, 130, 40}, 0.05, -0.12, 0.08)};
  const Camera camera = look_at({0, -0.8, 0.6}, {0, 0, 0}, 40, 480, 360);
  const auto regions = find_regions(render(scene, camera), &camera);
  ASSERT_EQ(regions.size(), 3U);
  const char* const expected[][3] = {
    {"large", "red", "cube"}, {"small", "blue", "sphere"}, {"small", "green", "triangle"}};
  for (const auto& [size, colour, shape] : expected) {
    const auto found = std::find_if(regions.begin(), regions.end(), [&](const Region& region) {
      return region.colour.value == colour;
    });
    ASSERT_NE(found, regions.end()) << colour;
    EXPECT_EQ(found->shape.value, shape);
    EXPECT_EQ(found->size.value, size);
    EXPECT_TRUE(found->roi.has_features);
    const auto& object = scene.objects[static_cast<std::size_t>(
      std::find_if(std::begin(expected), std::end(expected),
                   [&](const auto& words) { return words[1] == std::string(colour); }) -
      std::begin(expected))];
    EXPECT_NEAR(found->roi.features.extent.centroid.x, object.x, 0.03) << colour;
    EXPECT_NEAR(found->roi.features.extent.centroid.y, object.y, 0.03) << colour;
  }
}

TEST(Regions, are_as_long_as_their_sides_however_they_are_turned) {
  TabletopSnapshot scene;
  scene.table.material = TableLook::Material::plain;
  scene.table.colour = {200, 200, 200};
  scene.objects = {thing(TabletopShape::cube, {180, 30, 30}, -0.1, 0.05, 0.05),
                   thing(TabletopShape::sphere, {30, 60, 190}, 0.12, 0.05, 0.06)};
  scene.objects.front().turned_degrees = 40;
  const Camera camera = look_at({0, -0.34, 0.92}, {0, 0.02, 0}, 38, 640, 480);
  const auto regions = find_regions(render(scene, camera), &camera);
  ASSERT_EQ(regions.size(), 2U);
  for (const auto& region : regions) {
    const bool is_cube = region.colour.value == "red";
    const auto& features = region.roi.features;
    EXPECT_EQ(region.shape.value, is_cube ? "cube" : "sphere");
    EXPECT_NEAR(features.lengths.x, is_cube ? 0.05 : 0.06, 0.003) << region.colour.value;
    // The box around it is as wide as its diagonal.
    if (is_cube) {
      EXPECT_GT(features.extent.size.x, 0.06);
    }
  }
  Camera assumed = camera;
  assumed.is_assumed = true;
  for (const auto& region : find_regions(render(scene, camera), &assumed))
    EXPECT_EQ(region.roi.features.lengths, Point3{});
}

TEST(Regions, have_no_size_without_a_camera) {
  cv::Mat picture(120, 160, CV_8UC3, cv::Scalar::all(180));
  cv::circle(picture, {80, 60}, 20, {30, 30, 170}, cv::FILLED);
  const auto regions = find_regions(to_image(picture));
  ASSERT_EQ(regions.size(), 1U);
  EXPECT_EQ(regions[0].colour.value, "red");
  EXPECT_EQ(regions[0].size.value, "unknown");
  EXPECT_EQ(regions[0].roi.features.extent, AlignedBox{});
}

TEST(Regions, are_only_round_where_the_camera_is_not_known) {
  const Camera known = look_at({0, -0.8, 0.6}, {0, 0, 0}, 40, 480, 360);
  const Camera assumed = nominal_camera(480, 360);
  for (const auto& [shape, name] :
       {std::pair(TabletopShape::sphere, "sphere"), std::pair(TabletopShape::disc, "circle")}) {
    TabletopSnapshot scene;
    scene.table.material = TableLook::Material::plain;
    scene.table.colour = {200, 200, 200};
    scene.objects = {thing(shape, {30, 60, 190}, 0, 0, 0.08)};
    const Image image = render(scene, known);
    const auto measured = find_regions(image, &known);
    ASSERT_EQ(measured.size(), 1U) << name;
    EXPECT_EQ(measured[0].shape.value, name);
    for (const Camera* camera : {static_cast<const Camera*>(nullptr), &assumed}) {
      const auto guessed = find_regions(image, camera);
      ASSERT_EQ(guessed.size(), 1U) << name;
      EXPECT_EQ(guessed[0].shape.value, "round") << name;
    }
  }
}

TEST(Regions, HaveUncertainSizesWhereTheCameraIsAssumed) {
  const Camera known = look_at({0, -0.8, 0.6}, {0, 0, 0}, 40, 480, 360);
  Camera assumed = known;
  assumed.is_assumed = true;
  TabletopSnapshot scene;
  scene.table.material = TableLook::Material::plain;
  scene.table.colour = {200, 200, 200};
  scene.objects = {thing(TabletopShape::cube, {30, 60, 190}, 0, 0, 0.05)};
  const Image image = render(scene, known);
  const auto measured = find_regions(image, &known);
  const auto guessed = find_regions(image, &assumed);
  ASSERT_EQ(measured.size(), 1U);
  ASSERT_EQ(guessed.size(), 1U);
  EXPECT_EQ(measured[0].size.value, "small");
  EXPECT_GT(measured[0].size.confidence, 0.9);
  EXPECT_EQ(guessed[0].size.value, "small");
  EXPECT_LT(guessed[0].size.confidence, 0.8);
}

TEST(Regions, show_the_pixels_of_their_box) {
  cv::Mat picture(120, 160, CV_8UC3, cv::Scalar::all(180));
  picture.at<cv::Vec3b>(40, 50) = {1, 2, 3};
  const Image image = to_image(picture);
  const Segment segment{{{51, 41}, 3, 3}, Image{3, 3, 1, std::vector<std::uint8_t>(9, 255)}, {}};
  const ROI roi = make_roi(image, segment);
  EXPECT_EQ(roi.region.width, 3U);
  EXPECT_EQ(roi.region.bytes[0], 1);
  EXPECT_EQ(roi.region.bytes[1], 2);
  EXPECT_EQ(roi.region.bytes[2], 3);
  EXPECT_FALSE(roi.has_features);
  EXPECT_THROW(make_roi(image, {{{0, 0}, 9, 9}, {}, {}}), std::invalid_argument);
}

} // namespace
} // namespace castor::vision
