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

/// A ball of a paint under a lamp with intensity `light`, on a sheet of the reflectance 0.6 (both
/// linear), with a highlight and a dark side.
Patch ball(const cv::Vec3d& paint_bgr, double light) {
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
      cv::Vec3d colour = cv::Vec3d::all(0.6 * light);
      if (u * u + v * v <= 1) {
        mask(y, x) = 255;
        const double w = std::sqrt(1 - u * u - v * v);
        const double facing = std::max(0.0, 0.5 * w - 0.3 * u - 0.8 * v);
        const double highlight = std::pow(facing, 40);
        const double gloss = 0.04 + highlight;
        colour = paint_bgr * (light * (0.3 + 0.8 * facing)) + cv::Vec3d::all(light * gloss);
      }
      for (int c = 0; c < 3; ++c)
        pixels(y, x)[c] = encode(colour[c]);
    }
  }
  return {to_image(pixels), to_image(mask)};
}

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
