#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <string>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "castor/mapping/geometry/camera_model.hpp"
#include "castor/perception/vision/opencv_bridge.hpp"
#include "castor/perception/vision/recognition/regions.hpp"
#include "castor/perception/vision/recognition/shape_classifier.hpp"
#include "castor/perception/vision/recognition/shape_evidence.hpp"
#include "castor/perception/vision/tabletop/tabletop_renderer.hpp"

namespace castor::vision {

using namespace geometry;
namespace {

double measurement(const std::vector<double>& evidence, const std::string& name) {
  const auto& names = shape_measurements();
  const auto found = std::find(names.begin(), names.end(), name);
  EXPECT_NE(found, names.end()) << name;
  return evidence.at(static_cast<std::size_t>(found - names.begin()));
}

std::vector<double> measure(const cv::Mat& mask, double brightness = 120) {
  return measure_shape(to_image(cv::Mat(mask.size(), CV_8UC1, cv::Scalar(brightness))),
                       to_image(mask));
}

cv::Mat disc(int radius) {
  cv::Mat mask(2 * radius + 1, 2 * radius + 1, CV_8UC1, cv::Scalar(0));
  cv::circle(mask, {radius, radius}, radius, 255, cv::FILLED);
  return mask;
}

cv::Mat triangle(int side) {
  cv::Mat mask(side, side, CV_8UC1, cv::Scalar(0));
  const std::vector<cv::Point> corners{{side / 2, 0}, {side - 1, side - 1}, {0, side - 1}};
  cv::fillConvexPoly(mask, corners, 255);
  return mask;
}

TEST(ShapeEvidence, measures_a_disc) {
  const auto evidence = measure(disc(20));
  ASSERT_EQ(evidence.size(), shape_measurements().size());
  for (int i = 0; i < 24; ++i)
    EXPECT_NEAR(measurement(evidence, "support_" + std::to_string(i)), 1, 0.04);
  EXPECT_GT(measurement(evidence, "ellipse"), 0.95);
  EXPECT_GT(measurement(evidence, "solidity"), 0.95);
  EXPECT_NEAR(measurement(evidence, "rectangle"), 0.785, 0.04);
  EXPECT_LT(measurement(evidence, "variation"), 1e-6);
}

TEST(ShapeEvidence, measures_polygons) {
  const auto square = measure(cv::Mat(30, 30, CV_8UC1, cv::Scalar(255)));
  EXPECT_GT(measurement(square, "rectangle"), 0.97);
  EXPECT_NEAR(measurement(square, "corners_4"), 4 / 5.0, 1e-9);
  const auto three = measure(triangle(40));
  EXPECT_GT(measurement(three, "triangle"), 0.9);
  EXPECT_NEAR(measurement(three, "corners_8"), 3 / 5.0, 1e-9);
}

TEST(ShapeEvidence, does_not_depend_on_size) {
  const auto small = measure(disc(12));
  const auto large = measure(disc(48));
  for (std::size_t i = 0; i < small.size(); ++i)
    EXPECT_NEAR(small[i], large[i], 0.25) << shape_measurements()[i];
}

TEST(ShapeEvidence, sees_the_edge_between_two_faces) {
  const cv::Mat mask(40, 40, CV_8UC1, cv::Scalar(255));
  cv::Mat faces(40, 40, CV_8UC1, cv::Scalar(160));
  faces(cv::Rect(20, 0, 20, 40)) = 80;
  const auto evidence = measure_shape(to_image(faces), to_image(mask));
  EXPECT_NEAR(measurement(evidence, "step_lower"), 80 / 120.0, 0.05);
  EXPECT_GT(measurement(evidence, "smooth_lower"), 0.95);
  EXPECT_LT(measurement(evidence, "step_rows"), 0.01);
  EXPECT_GT(measurement(evidence, "light_0"), 0.2);
  EXPECT_LT(measurement(evidence, "light_3"), -0.2);
}

TEST(ShapeEvidence, has_nothing_to_say_of_next_to_nothing) {
  EXPECT_TRUE(measure(cv::Mat(3, 3, CV_8UC1, cv::Scalar(255))).empty());
  EXPECT_TRUE(measure(cv::Mat(1, 50, CV_8UC1, cv::Scalar(255))).empty());
  EXPECT_THROW(measure_shape(Image{2, 2, 1, {0, 0, 0, 0}}, Image{1, 1, 1, {0}}),
               std::invalid_argument);
}

TEST(ShapeClassifier, ranks_all_shapes_and_sums_to_one) {
  const auto shapes = classify_shape(measure(disc(20)), {.min_confidence = 0});
  ASSERT_EQ(shapes.size(), shape_vocabulary().size());
  double sum = 0;
  for (const auto& shape : shapes)
    sum += shape.confidence;
  EXPECT_NEAR(sum, 1, 1e-9);
}

TEST(ShapeClassifier, says_unknown_when_it_is_not_sure) {
  ShapeNetwork undecided{2, 1, 7, {}};
  undecided.weights.assign(undecided.size(), 0.0F);
  const std::vector<double> evidence{1, 2};
  const auto shapes = classify_shape(evidence, {}, undecided);
  EXPECT_EQ(shapes.front().value, "unknown");
  double sum = 0;
  for (const auto& shape : shapes)
    sum += shape.confidence;
  EXPECT_NEAR(sum, 1, 1e-9);
  EXPECT_EQ(classify_shape({}).front().value, "unknown");
}

TEST(ShapeClassifier, WeighsShapesByOutlines) {
  ShapeNetwork undecided{2, 1, 7, {}};
  undecided.weights.assign(undecided.size(), 0.0F);
  const std::vector<double> evidence{1, 2};
  const std::map<std::string, double> clear{{"cube", 0.016}, {"square", 0.035}, {"sphere", 0.042}};
  const auto shapes = classify_shape(evidence, {}, undecided, clear);
  EXPECT_EQ(shapes.front().value, "cube");
  // Whether it is a rectangle is not known by that.
  EXPECT_GT(shapes.front().confidence, shapes.back().confidence * 4);
  double sum = 0;
  for (const auto& shape : shapes)
    sum += shape.confidence;
  EXPECT_NEAR(sum, 1, 1e-9);
  const std::map<std::string, double> hidden{{"cube", 0.04}, {"square", 0.07}};
  EXPECT_EQ(classify_shape(evidence, {}, undecided, hidden).front().value, "unknown");
}

TEST(ShapeClassifier, keeps_to_the_candidates) {
  const auto shapes = classify_shape(measure(triangle(40)), {.candidates = {"cube", "sphere"}});
  for (const auto& shape : shapes)
    EXPECT_TRUE(shape.value == "cube" || shape.value == "sphere" || shape.value == "unknown");
  EXPECT_THROW(classify_shape(measure(disc(20)), {.candidates = {"teapot"}}),
               std::invalid_argument);
}

TEST(ShapeClassifier, says_round_where_balls_and_discs_look_the_same) {
  const auto shapes = classify_shape(measure(disc(20)), {.tells_round_apart = false});
  EXPECT_EQ(shapes.front().value, round_shape);
  double sum = 0;
  for (const auto& shape : shapes) {
    EXPECT_NE(shape.value, "sphere");
    EXPECT_NE(shape.value, "circle");
    sum += shape.confidence;
  }
  EXPECT_NEAR(sum, 1, 1e-9);
  // What is known not to be flat is a ball.
  const auto solids = classify_shape(
    measure(disc(20)), {.candidates = {"cube", "sphere"}, .tells_round_apart = false});
  EXPECT_EQ(solids.front().value, "sphere");
}

TEST(ShapeClassifier, refuses_evidence_of_another_kind) {
  const std::vector<double> evidence{1, 2, 3};
  EXPECT_THROW(classify_shape(evidence), std::invalid_argument);
}

/// How many of 8 rendered views of a blue thing, turned differently, are called by `name`.
int views_called(const std::string& name, TabletopShape shape, const Point3& size) {
  int called = 0;
  for (int view = 0; view < 8; ++view) {
    TabletopSnapshot scene;
    scene.table.material = TableLook::Material::plain;
    scene.table.colour = {200, 200, 200};
    TabletopObject thing;
    thing.shape = shape;
    thing.colour = {40, 70, 190};
    thing.size = size;
    thing.turned_degrees = 11 + 25 * view;
    thing.x = 0.02 * (view - 4);
    scene.objects.push_back(thing);
    const Camera camera = look_at({0, -0.7, 0.55}, {0, 0, 0}, 35, 320, 240);
    const auto regions = find_regions(render(scene, camera), &camera);
    // Beside a shadow that is taken for a thing, the thing itself is the coloured one.
    const bool right = std::any_of(regions.begin(), regions.end(), [&](const Region& region) {
      return region.colour.value == "blue" && region.shape.value == name;
    });
    if (right)
      ++called;
  }
  return called;
}

/// A shape drawn on a light ground, a little out of focus.
cv::Mat drawn(const cv::Scalar& bgr, const std::vector<cv::Point>& corners) {
  cv::Mat picture(120, 160, CV_8UC3, cv::Scalar::all(200));
  if (corners.empty())
    cv::circle(picture, {80, 60}, 24, bgr, cv::FILLED, cv::LINE_AA);
  else
    cv::fillConvexPoly(picture, corners, bgr, cv::LINE_AA);
  cv::GaussianBlur(picture, picture, {}, 1.2);
  return picture;
}

TEST(ShapeClassifier, TellsFlatPiecesOfEveryColour) {
  const std::pair<const char*, cv::Scalar> colours[] = {
    {"red", {30, 30, 200}},   {"orange", {0, 128, 255}},  {"yellow", {0, 220, 250}},
    {"green", {40, 150, 30}}, {"blue", {190, 60, 30}},    {"purple", {150, 40, 120}},
    {"brown", {20, 60, 110}}, {"grey", {120, 120, 120}},  {"black", {0, 0, 0}},
    {"dark", {20, 20, 20}},   {"white", {255, 255, 255}},
  };
  const std::vector<cv::Point> triangle{{80, 28}, {110, 80}, {50, 80}};
  const std::vector<cv::Point> tilted{{90, 30}, {104, 84}, {52, 66}};
  for (const auto& [name, bgr] : colours)
    for (const auto& [corners, shape] :
         {std::pair(triangle, "triangle"), std::pair(tilted, "triangle"),
          std::pair(std::vector<cv::Point>{}, "round")}) {
      const auto regions = find_regions(to_image(drawn(bgr, corners)));
      ASSERT_EQ(regions.size(), 1U) << name << ' ' << shape;
      EXPECT_EQ(regions[0].shape.value, shape) << name;
      const auto& evidence = regions[0].roi.features.shape_evidence;
      EXPECT_LT(measurement(evidence, "variation"), 0.3) << name << ' ' << shape;
    }
}

TEST(ShapeClassifier, tells_rendered_solids) {
  EXPECT_GE(views_called("cube", TabletopShape::cube, {0.07, 0.07, 0.07}), 7);
  EXPECT_GE(views_called("cylinder", TabletopShape::cylinder, {0.06, 0.06, 0.08}), 7);
  EXPECT_GE(views_called("cylinder", TabletopShape::cylinder, {0.05, 0.05, 0.1}), 7);
  EXPECT_GE(views_called("sphere", TabletopShape::sphere, {0.07, 0.07, 0.07}), 7);
}

TEST(ShapeClassifier, tells_rendered_flat_pieces) {
  EXPECT_GE(views_called("square", TabletopShape::square, {0.08, 0.08, 0.005}), 7);
  EXPECT_GE(views_called("rectangle", TabletopShape::rectangle, {0.12, 0.05, 0.005}), 7);
  EXPECT_GE(views_called("triangle", TabletopShape::triangle, {0.09, 0.09, 0.005}), 7);
  EXPECT_GE(views_called("circle", TabletopShape::disc, {0.08, 0.08, 0.005}), 7);
}

} // namespace
} // namespace castor::vision
