#include "castor/benchmarks/nlvr/nlvr_pictures.hpp"
#include "castor/benchmarks/nlvr/picture_boxes.hpp"
#include "castor/perception/vision/opencv_bridge.hpp"

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include <vector>

namespace castor::nlvr {

namespace {

using communication::test::PicturedItem;

const cv::Scalar light_grey(211, 211, 211);
const cv::Scalar dark_grey(128, 128, 128);
const cv::Scalar white(255, 255, 255);
const cv::Scalar yellow(0, 255, 255);
const cv::Scalar blue(255, 153, 0);
const cv::Scalar black(0, 0, 0);

/// Boxes of 100 by 100 pixels, with 50 between them.
cv::Mat boxes(int number, const cv::Scalar& between = dark_grey) {
  cv::Mat picture(100, 150 * number - 50, CV_8UC3, between);
  for (int i = 0; i < number; ++i)
    cv::rectangle(picture, {150 * i, 0, 100, 100}, light_grey, cv::FILLED);
  return picture;
}

void square(cv::Mat& picture, int x, int y, int size, const cv::Scalar& colour) {
  cv::rectangle(picture, {x, y, size, size}, colour, cv::FILLED);
}

std::vector<Items> seen(const cv::Mat& picture) {
  return see_boxes(vision::to_image(picture));
}

Agreement agreement(const std::vector<Items>& drawn, const std::vector<Items>& seen) {
  Agreement result;
  compare(drawn, seen, result);
  return result;
}

} // namespace

TEST(PictureBoxes, AreTheAreasThatHoldThings) {
  auto picture = boxes(3);
  square(picture, 170, 30, 20, blue);
  auto found = find_picture_boxes(vision::to_image(picture));
  ASSERT_EQ(found.size(), 3);
  EXPECT_EQ(vision::pixels_of(found[0]), cv::Rect(0, 0, 100, 100));
  EXPECT_EQ(vision::pixels_of(found[1]), cv::Rect(150, 0, 100, 100));
  EXPECT_EQ(vision::pixels_of(found[2]), cv::Rect(300, 0, 100, 100));
}

TEST(PictureBoxes, MayHaveAnyGroundBetweenThem) {
  auto picture = boxes(2, white);
  square(picture, 80, 80, 20, blue);
  square(picture, 160, 10, 30, black);
  EXPECT_EQ(find_picture_boxes(vision::to_image(picture)).size(), 2);
}

TEST(PictureBoxes, AreNoneWithoutAnythingInThem) {
  EXPECT_TRUE(find_picture_boxes(vision::to_image(boxes(3))).empty());
}

TEST(PictureBoxes, NeedAPicture) {
  EXPECT_THROW(find_picture_boxes({}), std::invalid_argument);
}

TEST(SeenBoxes, HoldWhatWasDrawn) {
  // Drawn large and shrunk, so that edges are smooth.
  constexpr int scale = 8;
  cv::Mat picture;
  cv::resize(boxes(2), picture, {}, scale, scale, cv::INTER_NEAREST);
  square(picture, 70 * scale, 70 * scale, 30 * scale, yellow);
  cv::circle(picture, {30 * scale, 40 * scale}, 10 * scale, black, cv::FILLED);
  const std::vector<cv::Point> corners{
    {200 * scale, 50 * scale}, {190 * scale, 70 * scale}, {210 * scale, 70 * scale}};
  cv::fillConvexPoly(picture, corners, blue);
  cv::resize(picture, picture, {}, 1.0 / scale, 1.0 / scale, cv::INTER_AREA);
  const std::vector<Items> drawn{
    {{"square", "yellow", 0.07, 0, 0.03}, {"circle", "black", 0.02, 0.05, 0.02}},
    {{"triangle", "blue", 0.04, 0.03, 0.02}}};
  const auto result = agreement(drawn, seen(picture));
  EXPECT_EQ(result.seen, 3);
  EXPECT_EQ(result.found, 3);
  EXPECT_EQ(result.same_pictures, 1);
}

TEST(SeenBoxes, HoldEachBlockOfATower) {
  auto picture = boxes(1);
  for (int i = 0; i < 4; ++i)
    square(picture, 40, 80 - 21 * i, 20, yellow);
  const auto items = seen(picture).at(0);
  ASSERT_EQ(items.size(), 4);
  for (auto& x : items) {
    EXPECT_EQ(x.shape, "square");
    EXPECT_EQ(x.colour, "yellow");
    EXPECT_NEAR(x.size, 0.02, 0.0005);
  }
}

TEST(Agreement, CountsWhatIsMissingAndWhatDiffers) {
  const PicturedItem one{"square", "yellow", 0, 0, 0.02};
  const PicturedItem other{"circle", "blue", 0.05, 0.05, 0.03};
  auto recoloured = one;
  recoloured.colour = "black";
  const auto result = agreement({{one, other}}, {{recoloured}});
  EXPECT_EQ(result.drawn, 2);
  EXPECT_EQ(result.seen, 1);
  EXPECT_EQ(result.found, 1);
  EXPECT_EQ(result.same_colour, 0);
  EXPECT_EQ(result.same_shape, 1);
  EXPECT_EQ(result.same_pictures, 0);
  EXPECT_EQ(agreement({{one, other}}, {{other, one}}).same_pictures, 1);
}

} // namespace castor::nlvr
