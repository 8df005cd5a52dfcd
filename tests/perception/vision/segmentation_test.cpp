#include "castor/perception/vision/segmentation/segmentation.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "castor/perception/vision/opencv_bridge.hpp"

namespace castor::vision {
namespace {

/// A grey sheet, brighter towards the lower right, with a sensor's noise.
cv::Mat shaded_sheet(int width = 320, int height = 240) {
  cv::Mat sheet(height, width, CV_8UC3);
  cv::RNG random(1);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double level = 90 + 60.0 * x / width + 40.0 * y / height + random.gaussian(1.5);
      const auto grey = cv::saturate_cast<std::uint8_t>(level);
      sheet.at<cv::Vec3b>(y, x) = {grey, grey, grey};
    }
  }
  return sheet;
}

std::vector<Segment> segments_of(const cv::Mat& pixels, const SegmentationOptions& options = {}) {
  return segment(to_image(pixels), options);
}

bool box_is(const Segment& found, const cv::Rect& expected, double tolerance = 2) {
  return std::abs(found.box.center.x - (expected.x + (expected.width - 1) / 2.0)) <= tolerance &&
         std::abs(found.box.center.y - (expected.y + (expected.height - 1) / 2.0)) <= tolerance &&
         std::abs(found.box.width - expected.width) <= 2 * tolerance &&
         std::abs(found.box.height - expected.height) <= 2 * tolerance;
}

TEST(Segmentation, finds_nothing_on_an_empty_sheet) {
  EXPECT_TRUE(segments_of(shaded_sheet()).empty());
}

TEST(Segmentation, rejects_an_image_without_pixels) {
  EXPECT_THROW(segment(Image{}), std::invalid_argument);
  EXPECT_THROW(segment(Image{4, 4, 3, {1, 2, 3}}), std::invalid_argument);
}

TEST(Segmentation, finds_a_coloured_thing_where_it_is) {
  cv::Mat picture = shaded_sheet();
  const cv::Rect thing(100, 80, 40, 30);
  cv::rectangle(picture, thing, {40, 40, 180}, cv::FILLED);
  const auto found = segments_of(picture);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_TRUE(box_is(found[0], thing));
}

TEST(Segmentation, gives_a_mask_of_the_box_and_an_outline_in_the_image) {
  cv::Mat picture = shaded_sheet();
  cv::circle(picture, {150, 120}, 20, {180, 80, 30}, cv::FILLED);
  const auto found = segments_of(picture);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_EQ(found[0].mask.width, found[0].box.width);
  EXPECT_EQ(found[0].mask.height, found[0].box.height);
  EXPECT_EQ(found[0].mask.channels, 1U);
  const auto on = std::count(found[0].mask.bytes.begin(), found[0].mask.bytes.end(), 255);
  EXPECT_NEAR(static_cast<double>(on), 3.1416 * 20 * 20, 150);
  for (const auto& point : found[0].contour)
    EXPECT_NEAR(std::hypot(point.x - 150, point.y - 120), 20, 2.5);
}

TEST(Segmentation, finds_a_grey_thing_on_a_grey_ground) {
  cv::Mat picture = shaded_sheet();
  const cv::Rect thing(60, 120, 40, 40);
  cv::rectangle(picture, thing, {80, 80, 80}, cv::FILLED);
  const auto found = segments_of(picture);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_TRUE(box_is(found[0], thing));
}

TEST(Segmentation, takes_a_soft_shadow_for_ground) {
  cv::Mat picture = shaded_sheet();
  cv::Mat shade(picture.size(), CV_32FC3, cv::Scalar::all(1));
  cv::ellipse(shade, {160, 130}, {60, 25}, 0, 0, 360, cv::Scalar::all(0.6), cv::FILLED);
  cv::GaussianBlur(shade, shade, cv::Size(), 8);
  cv::multiply(picture, shade, picture, 1, CV_8UC3);
  EXPECT_TRUE(segments_of(picture).empty());
}

TEST(Segmentation, takes_a_hard_shadow_at_the_foot_of_a_thing_for_ground) {
  cv::Mat picture = shaded_sheet();
  cv::ellipse(picture, {150, 141}, {24, 7}, 0, 0, 360, {78, 78, 78}, cv::FILLED);
  cv::GaussianBlur(picture, picture, cv::Size(), 2);
  cv::circle(picture, {150, 120}, 20, {40, 160, 60}, cv::FILLED);
  const auto found = segments_of(picture);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_TRUE(box_is(found[0], {130, 100, 41, 41}));
}

TEST(Segmentation, takes_a_large_hard_shadow_on_a_coloured_ground_for_ground) {
  cv::Mat picture(240, 320, CV_8UC3, {50, 170, 60});
  cv::circle(picture, {200, 150}, 30, cv::Scalar(50, 170, 60) * 0.6, cv::FILLED);
  const cv::Rect thing(130, 110, 50, 50);
  cv::rectangle(picture, thing, {30, 30, 150}, cv::FILLED);
  const auto found = segments_of(picture);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_TRUE(box_is(found[0], thing));
  SegmentationOptions options;
  options.shadow_angle = 0;
  EXPECT_EQ(segments_of(picture, options).size(), 2U);
}

/// Noise as strong as the differences in colour, instead of a texture.
void roughen(cv::Mat& picture) {
  cv::Mat noise(picture.size(), CV_16SC3);
  cv::RNG(1).fill(noise, cv::RNG::NORMAL, cv::Scalar::all(0), cv::Scalar::all(60));
  cv::add(picture, noise, picture, cv::noArray(), CV_8UC3);
}

TEST(Segmentation, finds_a_rough_thing_among_others_that_fill_the_frame) {
  cv::Mat picture(240, 320, CV_8UC3);
  picture(cv::Rect(0, 0, 160, 120)).setTo(cv::Scalar(160, 60, 60));
  picture(cv::Rect(160, 0, 160, 120)).setTo(cv::Scalar(60, 60, 170));
  picture(cv::Rect(0, 120, 160, 120)).setTo(cv::Scalar(60, 170, 60));
  picture(cv::Rect(160, 120, 160, 120)).setTo(cv::Scalar(70, 70, 70));
  cv::circle(picture, {160, 120}, 60, {70, 200, 220}, cv::FILLED);
  roughen(picture);
  const auto found = segments_of(picture);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_TRUE(box_is(found[0], {100, 60, 121, 121}, 6));
}

TEST(Segmentation, finds_rough_things_on_a_rough_ground) {
  cv::Mat picture(240, 320, CV_8UC3, cv::Scalar::all(200));
  const cv::Rect left(30, 60, 100, 120);
  const cv::Rect right(180, 60, 100, 120);
  cv::rectangle(picture, left, {60, 60, 160}, cv::FILLED);
  cv::rectangle(picture, right, {60, 150, 60}, cv::FILLED);
  roughen(picture);
  const auto found = segments_of(picture);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_TRUE(box_is(found[0], left, 6) || box_is(found[0], right, 6));
  EXPECT_TRUE(box_is(found[1], left, 6) || box_is(found[1], right, 6));
}

TEST(Segmentation, divides_touching_things_of_different_colours) {
  cv::Mat picture = shaded_sheet();
  const cv::Rect left(100, 80, 40, 40);
  const cv::Rect right(140, 100, 40, 40);
  cv::rectangle(picture, left, {40, 40, 180}, cv::FILLED);
  cv::rectangle(picture, right, {180, 60, 30}, cv::FILLED);
  const auto found = segments_of(picture);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_TRUE(box_is(found[0], left));
  EXPECT_TRUE(box_is(found[1], right));
}

TEST(Segmentation, divides_overlapping_discs_of_one_colour_along_their_edge) {
  cv::Mat picture = shaded_sheet();
  cv::circle(picture, {120, 120}, 25, {50, 150, 50}, cv::FILLED);
  cv::circle(picture, {163, 120}, 25, {50, 150, 50}, cv::FILLED);
  cv::circle(picture, {163, 120}, 25, {25, 90, 25}, 2);
  EXPECT_EQ(segments_of(picture).size(), 2U);
}

TEST(Segmentation, divides_touching_discs_of_one_colour_by_their_shape) {
  cv::Mat picture = shaded_sheet();
  cv::circle(picture, {120, 120}, 25, {50, 150, 50}, cv::FILLED);
  cv::circle(picture, {168, 128}, 25, {50, 150, 50}, cv::FILLED);
  const auto found = segments_of(picture);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_TRUE(box_is(found[0], {95, 95, 51, 51}));
  EXPECT_TRUE(box_is(found[1], {143, 103, 51, 51}));
}

TEST(Segmentation, leaves_a_metal_ball_with_highlights_and_mirrored_things_whole) {
  cv::Mat picture = shaded_sheet();
  cv::circle(picture, {150, 120}, 30, {140, 60, 40}, cv::FILLED);
  cv::ellipse(picture, {150, 136}, {26, 9}, 0, 0, 360, {70, 25, 15}, cv::FILLED);
  cv::circle(picture, {140, 106}, 6, {250, 240, 235}, cv::FILLED);
  cv::rectangle(picture, {158, 100, 8, 12}, {220, 180, 160}, cv::FILLED);
  const auto found = segments_of(picture);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_TRUE(box_is(found[0], {120, 90, 61, 61}));
}

TEST(Segmentation, joins_the_lit_and_the_shaded_side_of_a_thing) {
  cv::Mat picture = shaded_sheet();
  cv::rectangle(picture, {100, 80, 25, 50}, {40, 40, 200}, cv::FILLED);
  cv::rectangle(picture, {125, 80, 25, 50}, {20, 20, 110}, cv::FILLED);
  const auto found = segments_of(picture);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_TRUE(box_is(found[0], {100, 80, 50, 50}));
}

TEST(Segmentation, takes_a_highlight_for_part_of_the_thing) {
  cv::Mat picture = shaded_sheet();
  cv::circle(picture, {150, 120}, 25, {150, 50, 40}, cv::FILLED);
  cv::circle(picture, {142, 112}, 5, {250, 250, 250}, cv::FILLED);
  const auto found = segments_of(picture);
  ASSERT_EQ(found.size(), 1U);
  const auto on = std::count(found[0].mask.bytes.begin(), found[0].mask.bytes.end(), 255);
  EXPECT_NEAR(static_cast<double>(on), 3.1416 * 25 * 25, 200);
}

TEST(Segmentation, works_on_black_white_and_wooden_grounds) {
  for (const cv::Scalar& ground : {cv::Scalar(0, 0, 0), {255, 255, 255}, {110, 150, 190}}) {
    cv::Mat picture(240, 320, CV_8UC3, ground);
    const cv::Rect thing(100, 80, 40, 40);
    cv::rectangle(picture, thing, {150, 60, 20}, cv::FILLED);
    const auto found = segments_of(picture);
    ASSERT_EQ(found.size(), 1U) << ground;
    EXPECT_TRUE(box_is(found[0], thing)) << ground;
  }
}

TEST(Segmentation, works_on_grey_images) {
  cv::Mat picture;
  cv::cvtColor(shaded_sheet(), picture, cv::COLOR_BGR2GRAY);
  cv::rectangle(picture, {100, 80, 40, 40}, 30, cv::FILLED);
  EXPECT_EQ(segments_of(picture).size(), 1U);
}

TEST(Segmentation, drops_what_is_too_small) {
  cv::Mat picture = shaded_sheet();
  cv::rectangle(picture, {100, 80, 14, 14}, {40, 40, 180}, cv::FILLED);
  SegmentationOptions options;
  EXPECT_EQ(segments_of(picture, options).size(), 1U);
  options.min_area = 0.01;
  EXPECT_TRUE(segments_of(picture, options).empty());
}

TEST(Segmentation, finds_a_thing_that_fills_most_of_the_picture) {
  cv::Mat picture = shaded_sheet();
  const cv::Rect thing(30, 20, 260, 200);
  cv::rectangle(picture, thing, {40, 40, 180}, cv::FILLED);
  const auto found = segments_of(picture);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_TRUE(box_is(found[0], thing));
  SegmentationOptions options;
  options.max_area = 0.4;
  EXPECT_TRUE(segments_of(picture, options).empty());
}

TEST(Segmentation, takes_a_large_sheet_with_things_on_it_for_ground) {
  cv::Mat picture = shaded_sheet();
  cv::rectangle(picture, {30, 20, 260, 200}, {90, 160, 90}, cv::FILLED);
  const cv::Rect thing(120, 90, 40, 40);
  cv::rectangle(picture, thing, {40, 40, 180}, cv::FILLED);
  const auto found = segments_of(picture);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_TRUE(box_is(found[0], thing));
}

TEST(Segmentation, drops_what_the_border_cuts_off_unless_told_otherwise) {
  cv::Mat picture = shaded_sheet();
  cv::circle(picture, {160, 239}, 25, {40, 40, 180}, cv::FILLED);
  SegmentationOptions options;
  EXPECT_TRUE(segments_of(picture, options).empty());
  options.max_border = 1;
  EXPECT_EQ(segments_of(picture, options).size(), 1U);
}

TEST(Segmentation, answers_in_pixels_of_a_large_image) {
  cv::Mat picture = shaded_sheet(1600, 1200);
  const cv::Rect thing(500, 400, 200, 160);
  cv::rectangle(picture, thing, {40, 40, 180}, cv::FILLED);
  const auto found = segments_of(picture);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_TRUE(box_is(found[0], thing, 6));
  EXPECT_EQ(found[0].mask.width, found[0].box.width);
}

TEST(Segmentation, is_the_same_each_time) {
  cv::Mat picture = shaded_sheet();
  cv::circle(picture, {120, 120}, 25, {50, 150, 50}, cv::FILLED);
  cv::circle(picture, {170, 110}, 20, {50, 50, 150}, cv::FILLED);
  const auto first = segments_of(picture);
  const auto second = segments_of(picture);
  ASSERT_EQ(first.size(), second.size());
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(first[i].box, second[i].box);
    EXPECT_EQ(first[i].mask, second[i].mask);
  }
}

/// A chequered table cloth, too busy for segmentation without a model of it.
cv::Mat chequered_cloth(int seed) {
  cv::Mat cloth(240, 320, CV_8UC3);
  cv::RNG random(static_cast<std::uint64_t>(seed) + 1);
  for (int y = 0; y < cloth.rows; ++y) {
    for (int x = 0; x < cloth.cols; ++x) {
      const double level = ((x / 40 + y / 40) % 2 == 0 ? 90 : 190) + random.gaussian(2);
      const auto grey = cv::saturate_cast<std::uint8_t>(level);
      cloth.at<cv::Vec3b>(y, x) = {grey, grey, grey};
    }
  }
  return cloth;
}

BackgroundModel model_of_cloth() {
  BackgroundModel model;
  for (int i = 0; i < 20; ++i)
    model.learn(to_image(chequered_cloth(i)));
  return model;
}

TEST(SegmentationWithBackground, finds_only_what_was_not_there_before) {
  const BackgroundModel model = model_of_cloth();
  cv::Mat picture = chequered_cloth(100);
  EXPECT_TRUE(segment(to_image(picture), {}, &model).empty());
  const cv::Rect thing(100, 90, 30, 20);
  cv::rectangle(picture, thing, {30, 40, 180}, cv::FILLED);
  const auto found = segment(to_image(picture), {}, &model);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_TRUE(box_is(found[0], thing));
}

TEST(SegmentationWithBackground, tells_shadow_from_thing) {
  const BackgroundModel model = model_of_cloth();
  cv::Mat picture = chequered_cloth(100);
  cv::Mat shadow = picture(cv::Rect(30, 30, 60, 60));
  shadow *= 0.7;
  cv::rectangle(picture, {200, 100, 30, 30}, {30, 40, 180}, cv::FILLED);
  const auto mask = model.foreground(to_image(picture));
  int in_shadow = 0;
  int in_thing = 0;
  for (int y = 0; y < mask.height(); ++y) {
    for (int x = 0; x < mask.width(); ++x) {
      const bool on = mask.at(x, y) != 0;
      in_shadow += on && x < 100 ? 1 : 0;
      in_thing += on && x >= 200 && x < 230 && y >= 100 && y < 130 ? 1 : 0;
    }
  }
  EXPECT_LT(in_shadow, 60);
  EXPECT_EQ(in_thing, 900);
}

TEST(SegmentationWithBackground, refuses_images_of_another_size) {
  BackgroundModel model;
  const Image small = to_image(cv::Mat(10, 10, CV_8UC3, cv::Scalar::all(0)));
  EXPECT_THROW(model.foreground(small), std::invalid_argument);
  model.learn(small);
  EXPECT_EQ(model.images(), 1);
  const Image large = to_image(cv::Mat(20, 20, CV_8UC3, cv::Scalar::all(0)));
  EXPECT_THROW(model.learn(large), std::invalid_argument);
  EXPECT_THROW(segment(large, {}, &model), std::invalid_argument);
}

} // namespace
} // namespace castor::vision
