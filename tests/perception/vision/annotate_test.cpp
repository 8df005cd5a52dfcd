#include "castor/perception/vision/annotate.hpp"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include "castor/perception/vision/annotate_layout.hpp"

namespace castor::vision {

namespace {

Image grey_image(std::uint32_t width, std::uint32_t height, std::uint32_t channels = 3) {
  return {width, height, channels,
          std::vector<std::uint8_t>(std::size_t{width} * height * channels, 128)};
}

Annotation annotation_at(double x, double y, double side = 60) {
  Annotation annotation;
  annotation.box = {{x, y}, side, side};
  annotation.lines = {{"object", {}}, {"blue", 0.93}, {"square", 0.7}};
  return annotation;
}

std::size_t count_changed(const Image& image) {
  std::size_t count = 0;
  for (const auto byte : image.bytes)
    count += byte != 128;
  return count;
}

TEST(Annotate, LeavesAPictureWithoutAnnotationsAsItIs) {
  EXPECT_EQ(annotate(grey_image(640, 480), {}), grey_image(640, 480));
}

TEST(Annotate, DrawsOutlineFillAndLabel) {
  Annotation annotation = annotation_at(320, 240);
  annotation.colour = BgrColour{0, 0, 255};
  const std::vector<Annotation> annotations{annotation};
  const auto image = annotate(grey_image(640, 480), annotations);
  const auto pixel = [&](std::size_t x, std::size_t y) {
    const auto* p = &image.bytes[3 * (y * 640 + x)];
    return BgrColour{p[0], p[1], p[2]};
  };
  EXPECT_GT(pixel(290, 240).red, 200) << "outline";
  EXPECT_LT(pixel(290, 240).blue, 60);
  EXPECT_GT(pixel(320, 240).red, 135) << "fill";
  EXPECT_LT(pixel(320, 240).blue, 125);
  EXPECT_EQ(pixel(10, 10), (BgrColour{128, 128, 128})) << "far away";
  Annotation without_label = annotation;
  without_label.lines.clear();
  const std::vector<Annotation> unlabelled{without_label};
  EXPECT_GT(count_changed(image), count_changed(annotate(grey_image(640, 480), unlabelled)) + 3000);
}

TEST(Annotate, EnlargesSmallPictures) {
  const std::vector<Annotation> annotations{annotation_at(160, 120)};
  const auto image = annotate(grey_image(320, 240), annotations);
  EXPECT_EQ(image.width, 640U);
  EXPECT_EQ(image.height, 480U);
  AnnotateOptions options;
  options.min_side = 0;
  EXPECT_EQ(annotate(grey_image(320, 240), annotations, options).width, 320U);
  EXPECT_EQ(annotate(grey_image(1, 1), annotations).width, 8U) << "but not without limit";
}

TEST(Annotate, TakesGreyPictures) {
  const std::vector<Annotation> annotations{annotation_at(100, 100)};
  EXPECT_EQ(annotate(grey_image(640, 480, 1), annotations),
            annotate(grey_image(640, 480, 3), annotations));
}

TEST(Annotate, RefusesPicturesThatContradictThemselves) {
  EXPECT_THROW(annotate(Image{}, {}), std::invalid_argument);
  EXPECT_THROW(annotate(Image{2, 2, 3, {1, 2, 3}}, {}), std::invalid_argument);
  EXPECT_THROW(annotate(grey_image(4, 4, 4), {}), std::invalid_argument);
}

TEST(Annotate, SurvivesAnyCoordinates) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  std::vector<Annotation> annotations{annotation_at(-500, 900), annotation_at(1e300, -1e300),
                                      annotation_at(nan, 3),    annotation_at(5, infinity),
                                      annotation_at(0, 0, 1e9), annotation_at(5, 5, -3),
                                      annotation_at(5, 5, 0)};
  annotations[0].contour = {{1e12, 3}, {4, nan}, {5, 6}};
  annotations[1].lines = {{std::string(500, 'x'), 7.0}, {"", -1.0}, {"\xC3\xA9t\xC3\xA9\n", nan}};
  for (const std::uint32_t side : {1U, 20U, 640U}) {
    const auto image = annotate(grey_image(side, side), annotations);
    EXPECT_EQ(image.bytes.size(), std::size_t{image.width} * image.height * 3);
  }
}

TEST(Annotate, HasDifferentColoursForNeighbours) {
  for (std::size_t i = 0; i < 20; ++i)
    EXPECT_NE(annotation_colour(i), annotation_colour(i + 1));
}

TEST(PlaceLabels, KeepsLabelsApart) {
  std::vector<LayoutLabel> labels;
  for (int i = 0; i < 6; ++i)
    labels.push_back({{40.0 + 90 * i, 200.0 + 30 * (i % 2), 60, 60}, 110, 55});
  const auto places = place_labels(labels, {0, 0, 640, 480}, 6);
  ASSERT_EQ(places.size(), labels.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    EXPECT_EQ(shared_area(places[i], labels[i].region), 0);
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_EQ(shared_area(places[i], places[j]), 0) << i << " and " << j;
  }
}

TEST(PlaceLabels, PlacesNothingForLabelsWithoutSize) {
  const std::vector<LayoutLabel> labels{{{10, 10, 20, 20}, 0, 0}};
  EXPECT_EQ(place_labels(labels, {0, 0, 100, 100}, 5), std::vector<LayoutRect>{LayoutRect{}});
}

TEST(PlaceLabelsProperties, KeepsLabelsWithinThePicture) {
  EXPECT_TRUE(rc::check([] {
    std::vector<LayoutLabel> labels;
    const auto count = *rc::gen::inRange(0, 8);
    for (int i = 0; i < count; ++i) {
      const auto number = [](int low, int high) {
        return static_cast<double>(*rc::gen::inRange(low, high));
      };
      labels.push_back({{number(-100, 700), number(-100, 500), number(0, 300), number(0, 300)},
                        number(1, 200),
                        number(1, 100)});
    }
    for (const auto& place : place_labels(labels, {0, 0, 640, 480}, 6)) {
      RC_ASSERT(place.left >= 0);
      RC_ASSERT(place.top >= 0);
      RC_ASSERT(place.right() <= 640);
      RC_ASSERT(place.bottom() <= 480);
    }
  }));
}

} // namespace

} // namespace castor::vision
