// The texts and pictures of a map.

#include "castor/mapping/exports/carmen_text.hpp"
#include "castor/mapping/exports/g2o_text.hpp"
#include "castor/mapping/exports/map_picture.hpp"

#include <gtest/gtest.h>

#include <opencv2/imgcodecs.hpp>

#include <numbers>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace castor::mapping::test {

namespace {

using std::numbers::pi;

MapContents two_keyframes() {
  MapContents result;
  ExportedKeyframe x;
  x.time = 1'500'000;
  x.pose = {1, 2, 0.5};
  x.odometry = {1.25, 2, 0.5};
  x.scan.first_angle = -pi / 2;
  x.scan.angle_step = pi / 3;
  x.scan.max_range = 8;
  x.scan.ranges = {1, 0, 2.5};
  result.keyframes.push_back(x);
  x.time = 2'000'000;
  x.pose = {3, 2, -1};
  x.scan.first_angle = -pi;
  x.scan.mount = {1, 0, 1};
  result.keyframes.push_back(x);
  result.constraints.push_back({0, 1, {2, 0.25, -1.5}, {100, 0, 0, 200, 0, 300}});
  return result;
}

TEST(G2oText, HasVerticesAndEdges) {
  EXPECT_EQ(g2o_text(two_keyframes()), "VERTEX_SE2 0 1 2 0.5\n"
                                       "FIX 0\n"
                                       "VERTEX_SE2 1 3 2 -1\n"
                                       "EDGE_SE2 0 1 2 0.25 -1.5 100 0 0 200 0 300\n");
  auto map = two_keyframes();
  map.constraints[0].to = 2;
  EXPECT_THROW(g2o_text(map), std::out_of_range);
}

std::vector<std::string> words_of_line(const std::string& text, const std::string& begin) {
  std::istringstream lines{text};
  std::string line;
  std::vector<std::string> result;
  while (std::getline(lines, line))
    if (line.starts_with(begin + " ")) {
      std::istringstream words{line};
      for (std::string x; words >> x;)
        result.push_back(x);
    }
  return result;
}

TEST(CarmenText, AFrontLaserIsFlaser) {
  EXPECT_EQ(words_of_line(carmen_text(two_keyframes()), "FLASER"),
            (std::vector<std::string>{"FLASER", "3", "1.000", "8.000", "2.500", "1.000000",
                                      "2.000000", "0.500000", "1.250000", "2.000000", "0.500000",
                                      "1.500000", "castor", "1.500000"}));
}

TEST(CarmenText, OtherLasersSayTheirAngles) {
  auto words = words_of_line(carmen_text(two_keyframes()), "ROBOTLASER1");
  // 8 words, the count, 3 ranges, the number of remissions, 2 poses, 5 settings, times.
  ASSERT_EQ(words.size(), 8U + 1 + 3 + 1 + 6 + 5 + 3);
  EXPECT_EQ(words[2], "-3.141593");
  EXPECT_EQ(words[3], "2.094395");
  EXPECT_EQ(words[4], "1.047198");
  EXPECT_EQ(words[8], "3");
  EXPECT_EQ(words[12], "0");
  // The scanner is 1 m ahead of the robot at (3, 2), and turned by 1.
  EXPECT_EQ(words[13], "3.540302");
  EXPECT_EQ(words[14], "1.158529");
  EXPECT_EQ(words[15], "0.000000");
  EXPECT_EQ(words[16], "3.000000");
}

cv::Mat decoded(const std::string& png) {
  const std::vector<std::uint8_t> bytes(png.begin(), png.end());
  return cv::imdecode(bytes, cv::IMREAD_COLOR);
}

int pixels_of(const cv::Mat& picture, const cv::Vec3b& colour) {
  int result = 0;
  for (int y = 0; y < picture.rows; ++y)
    for (int x = 0; x < picture.cols; ++x)
      result += picture.at<cv::Vec3b>(y, x) == colour;
  return result;
}

TEST(MapPicture, ShowsCellsAndTracks) {
  CellMap map{40, 20, 0.05, {-1, 0, 0}, std::vector<std::int8_t>(800, 0)};
  for (int row = 0; row < 20; ++row)
    map.at(39, row) = 100;
  auto picture = decoded(map_picture(map, {{{{-0.5, 0.5, 0}, {0.5, 0.5, 0}}, 255, 0, 0}}));
  // 3 m x 2 m with the margin, enlarged by a whole number: 60 x 40 cells.
  EXPECT_EQ(picture.cols, 1200);
  EXPECT_EQ(picture.rows, 800);
  // The arrow at the end covers some of the wall.
  EXPECT_LE(pixels_of(picture, {0, 0, 0}), 20 * 20 * 20);
  EXPECT_GT(pixels_of(picture, {0, 0, 0}), 19 * 20 * 20);
  EXPECT_GT(pixels_of(picture, {0, 0, 255}), 400);
  // At (0, 0.5), with 400 pixels for a metre, from (-1.5, 1.5).
  EXPECT_EQ(picture.at<cv::Vec3b>(400, 600), (cv::Vec3b{0, 0, 255}));
  EXPECT_EQ(picture.at<cv::Vec3b>(250, 600), (cv::Vec3b{254, 254, 254}));
}

TEST(MapPicture, LargeMapsAreReduced) {
  CellMap map{4000, 2000, 0.05, {}, std::vector<std::int8_t>(8'000'000, -1)};
  auto picture = decoded(map_picture(map, {}));
  EXPECT_LE(picture.cols, 1200);
  EXPECT_GT(picture.cols, 600);
}

TEST(MapPicture, ATrackWithoutAMapIsDrawnToo) {
  EXPECT_GT(decoded(map_picture({}, {{{{0, 0, 0}, {5, 5, 1}}}})).cols, 100);
  EXPECT_THROW(map_picture({}, {}), std::invalid_argument);
}

} // namespace

} // namespace castor::mapping::test
