#include "castor/perception/vision/segmentation/segmentation.hpp"

#include <algorithm>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "castor/mapping/geometry/camera_model.hpp"
#include "castor/perception/vision/opencv_bridge.hpp"
#include "castor/perception/vision/tabletop/tabletop_renderer.hpp"

/// Segmentation of rendered tables, whose ground truth is known.
namespace castor::vision {

using namespace geometry;
namespace {

const Camera tilted_camera = look_at({0, -0.62, 0.55}, {0, 0.03, 0}, 42, 640, 480);

TabletopObject thing(TabletopShape shape, const SceneColour& colour, double x, double y) {
  TabletopObject object;
  object.shape = shape;
  object.colour = colour;
  object.x = x;
  object.y = y;
  object.size = {0.08, 0.08, is_flat(shape) ? 0.005 : 0.08};
  object.turned_degrees = 25;
  return object;
}

TabletopSnapshot table(TableLook::Material material, const SceneColour& colour) {
  TabletopSnapshot scene;
  scene.table.material = material;
  scene.table.colour = colour;
  return scene;
}

/// Intersection by union of a segment and the visible part of an object.
double overlap_with(const Segment& segment, const cv::Mat& labels, std::size_t object) {
  cv::Mat on(labels.size(), CV_8U, cv::Scalar(0));
  const cv::Rect box(static_cast<int>(segment.box.center.x - (segment.box.width - 1) / 2),
                     static_cast<int>(segment.box.center.y - (segment.box.height - 1) / 2),
                     static_cast<int>(segment.box.width), static_cast<int>(segment.box.height));
  as_mat(segment.mask).copyTo(on(box));
  const cv::Mat truth = labels == static_cast<int>(object + 1);
  const cv::Mat both = on & truth;
  const cv::Mat either = on | truth;
  return static_cast<double>(cv::countNonZero(both)) / cv::countNonZero(either);
}

/// Whether there is one segment for every object, and they overlap by at least `least`.
testing::AssertionResult finds_all(const TabletopSnapshot& scene, double least,
                                   const RenderOptions& options = {}) {
  const auto found = segment(render(scene, tilted_camera, options));
  if (found.size() != scene.objects.size())
    return testing::AssertionFailure()
           << found.size() << " segments for " << scene.objects.size() << " things";
  const Image labels = render_labels(scene, tilted_camera);
  for (std::size_t object = 0; object < scene.objects.size(); ++object) {
    double best = 0;
    for (const auto& segment : found)
      best = std::max(best, overlap_with(segment, as_mat(labels), object));
    if (best < least)
      return testing::AssertionFailure() << "thing " << object << " overlaps by " << best;
  }
  return testing::AssertionSuccess();
}

/// Things far from each other and from the ground in colour, under a low lamp.
TabletopSnapshot long_shadows(TableLook::Material material, const SceneColour& ground) {
  auto scene = table(material, ground);
  scene.light = {-0.9, 0.3, 0.8};
  scene.objects = {thing(TabletopShape::cube, {30, 60, 190}, -0.14, 0.05),
                   thing(TabletopShape::sphere, {230, 230, 230}, 0.14, 0.05),
                   thing(TabletopShape::cylinder, {30, 30, 30}, 0.0, -0.1)};
  return scene;
}

TEST(SegmentationOfTables, takes_hard_shadows_on_coloured_grounds_for_ground) {
  RenderOptions hard;
  hard.lamp_radius = 0.01;
  EXPECT_TRUE(finds_all(long_shadows(TableLook::Material::wood, {190, 150, 110}), 0.85, hard));
  EXPECT_TRUE(finds_all(long_shadows(TableLook::Material::cloth, {60, 110, 70}), 0.85, hard));
}

TEST(SegmentationOfTables, takes_hard_shadows_on_a_grey_ground_for_ground) {
  auto scene = table(TableLook::Material::plain, {200, 200, 200});
  scene.light = {-0.9, 0.3, 0.8};
  scene.objects = {thing(TabletopShape::cylinder, {30, 60, 190}, -0.14, 0.05),
                   thing(TabletopShape::sphere, {180, 30, 30}, 0.12, -0.05)};
  RenderOptions hard;
  hard.lamp_radius = 0.01;
  EXPECT_TRUE(finds_all(scene, 0.85, hard));
}

TEST(SegmentationOfTables, keeps_a_grey_thing_before_a_coloured_one_on_a_grey_ground) {
  auto scene = table(TableLook::Material::plain, {200, 200, 200});
  scene.objects = {thing(TabletopShape::cube, {180, 30, 30}, 0.0, 0.08),
                   thing(TabletopShape::sphere, {90, 90, 90}, 0.03, -0.02)};
  EXPECT_TRUE(finds_all(scene, 0.7));
}

TEST(SegmentationOfTables, finds_things_with_soft_outlines_on_a_textured_ground) {
  cv::Mat picture(240, 320, CV_8UC3, cv::Scalar(70, 110, 150));
  cv::circle(picture, {160, 120}, 45, {140, 120, 60}, cv::FILLED);
  cv::GaussianBlur(picture, picture, cv::Size(), 3);
  cv::Mat texture(picture.size(), CV_32F);
  cv::RNG(5).fill(texture, cv::RNG::NORMAL, 0, 60);
  cv::GaussianBlur(texture, texture, cv::Size(), 1.5);
  cv::circle(texture, {160, 120}, 45, 0, cv::FILLED);
  texture.convertTo(texture, CV_16S);
  cv::Mat grey;
  cv::merge(std::vector<cv::Mat>(3, texture), grey);
  cv::add(picture, grey, picture, cv::noArray(), CV_8UC3);
  const auto found = segment(to_image(picture));
  ASSERT_EQ(found.size(), 1U);
  EXPECT_NEAR(found[0].box.center.x, 160, 5);
  EXPECT_NEAR(found[0].box.center.y, 120, 5);
  EXPECT_NEAR(found[0].box.width, 90, 14);
  SegmentationOptions options;
  options.hue_difference = 1000;
  EXPECT_TRUE(segment(to_image(picture), options).empty()) << "the texture raises the limit";
}

TEST(SegmentationOfTables, takes_soft_shadows_for_ground) {
  RenderOptions soft;
  soft.lamp_radius = 0.2;
  EXPECT_TRUE(finds_all(long_shadows(TableLook::Material::wood, {190, 150, 110}), 0.85, soft));
  EXPECT_TRUE(finds_all(long_shadows(TableLook::Material::cloth, {60, 110, 70}), 0.85, soft));
}

TEST(SegmentationOfTables, tells_the_shadow_of_a_brown_thing_on_brown_wood_from_the_thing) {
  auto scene = table(TableLook::Material::wood, {190, 166, 134});
  scene.objects = {thing(TabletopShape::cube, {140, 90, 50}, -0.12, 0.05),
                   thing(TabletopShape::square, {110, 65, 30}, 0.12, 0.05)};
  EXPECT_TRUE(finds_all(scene, 0.8));
}

} // namespace
} // namespace castor::vision
