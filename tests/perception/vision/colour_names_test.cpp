#include "castor/perception/vision/recognition/colour_names.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "castor/perception/vision/opencv_bridge.hpp"

namespace castor::vision {
namespace {

/// The likeliest name of a colour given as red, green, blue of 255.
std::string name_of(int red, int green, int blue) {
  const auto shares = colour_shares({blue / 255.0, green / 255.0, red / 255.0});
  const auto best = std::max_element(shares.begin(), shares.end());
  return colour_vocabulary()[static_cast<std::size_t>(best - shares.begin())];
}

struct Patch {
  Image region;
  Image mask;
};

/// A ball of a paint under a lamp of this colour, on a ground of this reflectance (all of them
/// linear), with a highlight and a dark side.
Patch ball_on(const cv::Vec3d& ground_bgr, const cv::Vec3d& paint_bgr, const cv::Vec3d& light) {
  constexpr int side = 60;
  cv::Mat_<cv::Vec3b> pixels(side, side);
  cv::Mat_<std::uint8_t> mask(side, side, std::uint8_t{0});
  const auto encode = [](double linear) {
    return cv::saturate_cast<std::uint8_t>(255 * std::pow(std::clamp(linear, 0.0, 1.0), 1 / 2.2));
  };
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const double u = (x - 29.5) / 25;
      const double v = (y - 29.5) / 25;
      cv::Vec3d colour = ground_bgr.mul(light);
      if (u * u + v * v <= 1) {
        mask(y, x) = 255;
        const double w = std::sqrt(1 - u * u - v * v);
        const double facing = std::max(0.0, 0.5 * w - 0.3 * u - 0.8 * v);
        const double highlight = std::pow(facing, 40);
        const double gloss = 0.04 + highlight;
        colour = (paint_bgr * (0.3 + 0.8 * facing) + cv::Vec3d::all(gloss)).mul(light);
      }
      for (int c = 0; c < 3; ++c)
        pixels(y, x)[c] = encode(colour[c]);
    }
  }
  return {to_image(pixels), to_image(mask)};
}

/// The same on a white sheet in white light.
Patch ball(const cv::Vec3d& paint_bgr, double light) {
  return ball_on(cv::Vec3d::all(0.6), paint_bgr, cv::Vec3d::all(light));
}

std::string best_name(const Patch& patch) {
  const auto names = name_colour(patch.region, patch.mask);
  return names.empty() ? "" : names.front().value;
}

constexpr double dim = 0.4;
const cv::Vec3d white_sheet(0.6, 0.6, 0.6);
const cv::Vec3d grey_table(0.25, 0.25, 0.25);
const cv::Vec3d brown_wood(0.1, 0.2, 0.35);
const cv::Vec3d blue_cloth(0.3, 0.12, 0.08);
const cv::Vec3d green_cloth(0.1, 0.2, 0.08);

TEST(ColourNames, names_the_plain_colours) {
  EXPECT_EQ(name_of(255, 0, 0), "red");
  EXPECT_EQ(name_of(255, 128, 0), "orange");
  EXPECT_EQ(name_of(255, 255, 0), "yellow");
  EXPECT_EQ(name_of(0, 200, 0), "green");
  EXPECT_EQ(name_of(0, 255, 255), "cyan");
  EXPECT_EQ(name_of(0, 0, 255), "blue");
  EXPECT_EQ(name_of(130, 0, 200), "purple");
  EXPECT_EQ(name_of(255, 150, 200), "pink");
  EXPECT_EQ(name_of(110, 60, 10), "brown");
  EXPECT_EQ(name_of(128, 128, 128), "grey");
  EXPECT_EQ(name_of(0, 0, 0), "black");
  EXPECT_EQ(name_of(255, 255, 255), "white");
}

TEST(ColourNames, shares_sum_to_one_all_over_the_cube) {
  for (int red = 0; red <= 255; red += 51) {
    for (int green = 0; green <= 255; green += 51) {
      for (int blue = 0; blue <= 255; blue += 51) {
        const auto shares = colour_shares({blue / 255.0, green / 255.0, red / 255.0});
        EXPECT_EQ(shares.size(), colour_vocabulary().size());
        EXPECT_NEAR(std::accumulate(shares.begin(), shares.end(), 0.0), 1, 1e-9);
      }
    }
  }
  EXPECT_THROW(colour_shares({1, 2}), std::invalid_argument);
}

TEST(ColourNames, shares_have_no_jumps) {
  auto before = colour_shares({0, 0, 1});
  for (int degree = 1; degree <= 360; ++degree) {
    cv::Mat_<cv::Vec3f> hsv(1, 1, cv::Vec3f(static_cast<float>(degree % 360), 1, 1));
    cv::Mat_<cv::Vec3f> bgr;
    cv::cvtColor(hsv, bgr, cv::COLOR_HSV2BGR);
    const cv::Vec3f& pixel = bgr(0, 0);
    const auto now = colour_shares({static_cast<double>(pixel[0]), static_cast<double>(pixel[1]),
                                    static_cast<double>(pixel[2])});
    for (std::size_t i = 0; i < now.size(); ++i)
      EXPECT_NEAR(now[i], before[i], 0.1) << degree;
    before = now;
  }
}

TEST(ColourNames, sees_paint_in_any_light) {
  struct Case {
    cv::Vec3d paint_bgr;
    const char* name;
  };
  const Case cases[] = {{{0.03, 0.03, 0.55}, "red"},    {{0.05, 0.7, 0.85}, "yellow"},
                        {{0.03, 0.25, 0.04}, "green"},  {{0.5, 0.1, 0.03}, "blue"},
                        {{0.015, 0.09, 0.22}, "brown"}, {{0.1, 0.1, 0.1}, "grey"},
                        {{0.45, 0.03, 0.2}, "purple"}};
  for (const auto& [paint, name] : cases) {
    for (const double light : {0.5, 0.7, 1.0}) {
      const Patch patch = ball(paint, light);
      const auto names = name_colour(patch.region, patch.mask);
      ASSERT_FALSE(names.empty());
      EXPECT_EQ(names[0].value, name) << "in light " << light;
    }
  }
}

TEST(ColourNames, tells_orange_from_yellow_on_any_ground) {
  const cv::Vec3d orange(0.02, 0.22, 0.85);
  for (const auto& ground : {white_sheet, grey_table, brown_wood, blue_cloth, green_cloth})
    for (const double light : {0.6, 0.8, 1.0})
      EXPECT_EQ(best_name(ball_on(ground, orange, cv::Vec3d::all(light))), "orange")
        << ground << " in light " << light;
}

TEST(ColourNames, tells_brown_from_orange) {
  const cv::Vec3d brown(0.02, 0.07, 0.17);
  for (const auto& ground : {white_sheet, grey_table, brown_wood, blue_cloth})
    for (const double light : {dim, 0.7, 1.0})
      EXPECT_EQ(best_name(ball_on(ground, brown, cv::Vec3d::all(light))), "brown")
        << ground << " in light " << light;
}

TEST(ColourNames, tells_black_from_blue_in_light_of_any_colour) {
  const cv::Vec3d black(0.012, 0.012, 0.012);
  const cv::Vec3d blue(0.3, 0.06, 0.02);
  const cv::Vec3d sky(1.15, 1, 0.85);
  const cv::Vec3d lamp(0.7, 0.9, 1.1);
  for (const auto& light : {sky, lamp, dim * sky, dim * lamp}) {
    EXPECT_EQ(best_name(ball_on(white_sheet, black, light)), "black") << light;
    // Whether a dark ground is dark, or a bright one in little light, cannot be told.
    const auto on_grey = best_name(ball_on(grey_table, black, light));
    EXPECT_TRUE(on_grey == "black" || on_grey == "grey") << on_grey << light;
    for (const auto& ground : {white_sheet, grey_table})
      EXPECT_EQ(best_name(ball_on(ground, blue, light)), "blue") << ground << light;
  }
}

TEST(ColourNames, are_less_sure_where_the_light_decides) {
  const Patch between = ball({0.03, 0.19, 0.5}, 0.8);
  const auto names = name_colour(between.region, between.mask);
  EXPECT_LT(names.front().confidence, 0.8) << names.front().value;
}

TEST(ColourNames, AreRightAsOftenAsTheirConfidenceSays) {
  // Linear; typical paints, such as toys have.
  const std::pair<const char*, cv::Vec3d> paints[] = {
    {"red", {0.02, 0.02, 0.45}},   {"orange", {0.02, 0.2, 0.8}},  {"yellow", {0.02, 0.52, 0.72}},
    {"green", {0.03, 0.22, 0.02}}, {"cyan", {0.31, 0.31, 0.02}},  {"blue", {0.52, 0.05, 0.02}},
    {"purple", {0.3, 0.03, 0.2}},  {"pink", {0.4, 0.22, 0.87}},   {"brown", {0.02, 0.06, 0.16}},
    {"grey", {0.19, 0.19, 0.19}},  {"black", {0.02, 0.02, 0.02}}, {"white", {0.83, 0.83, 0.83}},
  };
  int sure = 0;
  int sure_and_right = 0;
  int all = 0;
  for (const auto& [name, paint] : paints)
    for (const auto& ground : {white_sheet, grey_table, brown_wood})
      for (const double light : {0.6, 0.8, 1.0}) {
        const auto patch = ball_on(ground, paint, cv::Vec3d::all(light));
        const auto best = name_colour(patch.region, patch.mask).front();
        ++all;
        if (best.confidence < 0.8)
          continue;
        ++sure;
        sure_and_right += best.value == name ? 1 : 0;
      }
  EXPECT_GE(sure, all * 0.6);
  EXPECT_GE(sure_and_right, sure * 0.95);
}

TEST(ColourNames, ranks_names_and_sums_to_one) {
  const Patch patch = ball({0.1, 0.3, 0.4}, 0.8);
  const auto names = name_colour(patch.region, patch.mask);
  double sum = 0;
  for (std::size_t i = 0; i < names.size(); ++i) {
    sum += names[i].confidence;
    if (i > 0) {
      EXPECT_LE(names[i].confidence, names[i - 1].confidence);
    }
  }
  EXPECT_NEAR(sum, 1, 1e-9);
}

TEST(ColourNames, copes_with_odd_regions) {
  const Image grey = to_image(cv::Mat(8, 8, CV_8UC1, cv::Scalar(120)));
  const Image all = to_image(cv::Mat(8, 8, CV_8UC1, cv::Scalar(255)));
  const Image none = to_image(cv::Mat(8, 8, CV_8UC1, cv::Scalar(0)));
  EXPECT_EQ(name_colour(grey, all).front().value, "grey");
  EXPECT_TRUE(name_colour(grey, none).empty());
  EXPECT_THROW(name_colour(grey, Image{4, 4, 1, std::vector<std::uint8_t>(16)}),
               std::invalid_argument);
}

} // namespace
} // namespace castor::vision
