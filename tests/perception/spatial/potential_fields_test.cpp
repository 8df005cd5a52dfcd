#include "castor/perception/spatial/potential_fields.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <vector>

namespace castor::spatial {

namespace {

using enum SpatialRelation;

/// What the golden numbers are rounded to.
constexpr double digits = 0.5e-4;

constexpr GroundPoint viewer{0, -1};
constexpr GroundPoint square{0.15, 0};
constexpr GroundPoint triangle{-0.15, 0};

PotentialFields fields_of(const std::vector<GroundPoint>& objects, FieldOptions options = {}) {
  return {objects, viewer, options};
}

/// The landmark is at the origin.
double value_at(SpatialRelation relation, GroundPoint target) {
  return fields_of({{0, 0}, target}).value(relation, 1, 0);
}

void expect_position(const TargetPosition& is, double x, double y, double value, double precision) {
  EXPECT_NEAR(is.position.x, x, 1e-9);
  EXPECT_NEAR(is.position.y, y, 1e-9);
  EXPECT_NEAR(is.value, value, precision);
}

TEST(PotentialFields, AreAsPublishedOnTheAxis) {
  const double distances[] = {0.05, 0.10, 0.20, 0.30, 0.40, 0.50, 0.80};
  const double rights[] = {.9646, .9293, .8586, .7879, .7172, .6464, .4343};
  const double nears[] = {.9305, .8636, .7372, .6207, .5143, .4179, .1886};
  for (std::size_t i = 0; i < std::size(distances); ++i) {
    EXPECT_NEAR(value_at(right, {distances[i], 0}), rights[i], digits) << distances[i];
    EXPECT_NEAR(value_at(near, {distances[i], 0}), nears[i], digits) << distances[i];
  }
}

TEST(PotentialFields, AreAsPublishedOffTheAxis) {
  const double angles[] = {0, 10, 20, 30, 45, 60, 89};
  const double rights[] = {.8586, .7778, .6885, .5692, .4300, .2913, .0000};
  for (std::size_t i = 0; i < std::size(angles); ++i) {
    const double angle = angles[i] * std::numbers::pi / 180;
    EXPECT_NEAR(value_at(right, {0.2 * std::cos(angle), 0.2 * std::sin(angle)}), rights[i], digits)
      << angles[i];
  }
}

TEST(PotentialFields, AreAsPublishedForASquareAndATriangle) {
  const auto fields = fields_of({square, triangle});
  EXPECT_NEAR(fields.value(right, 0, 1), .7261, digits);
  EXPECT_NEAR(fields.value(left, 1, 0), .7270, digits);
  EXPECT_NEAR(fields.value(near, 0, 1), .6435, digits);
  EXPECT_NEAR(fields.value(near, 1, 0), .6450, digits);
  EXPECT_EQ(fields.value(left, 0, 1), 0);
  EXPECT_EQ(fields.value(right, 0, 0), 0);
}

TEST(PotentialFields, FindThePublishedPositions) {
  const auto fields = fields_of({square, triangle});
  const auto to_the_right = fields.positions(right, 1, 3);
  ASSERT_EQ(to_the_right.size(), 3u);
  expect_position(to_the_right[0], 0, .02, 1, digits);
  expect_position(to_the_right[1], .29, .07, .788, 0.5e-3);
  expect_position(to_the_right[2], .16, .15, .701, 0.5e-3);
  const auto to_the_left = fields.positions(left, 1, 3);
  ASSERT_EQ(to_the_left.size(), 3u);
  expect_position(to_the_left[0], -.30, -.02, 1, digits);
  expect_position(to_the_left[1], -.45, -.04, .889, 0.5e-3);
  expect_position(to_the_left[2], -.60, -.07, .783, 0.5e-3);
}

TEST(PotentialFields, FindNoPositionWhereThereIsNone) {
  const std::vector<GroundPoint> enclosed{
    {0, 0}, {0.20, 0.15}, {-0.20, 0.15}, {0.20, -0.15}, {-0.21, -0.15}};
  // The original went on with a corner of the map, at value 0.
  EXPECT_EQ(fields_of(enclosed).positions(near, 0, 2).size(), 1u);
  // Objects all around leave no place at all.
  std::vector<GroundPoint> crowd{{0, 0}};
  for (int i = 0; i < 12; ++i) {
    const double angle = i * std::numbers::pi / 6;
    crowd.push_back({0.16 * std::cos(angle), 0.16 * std::sin(angle)});
  }
  EXPECT_EQ(fields_of(crowd).position(near, 0), std::nullopt);
}

TEST(PotentialFields, DependOnTheSizeOfTheMap) {
  FieldOptions small;
  small.map_size = 1;
  EXPECT_NEAR(fields_of({square, triangle}, small).value(right, 0, 1), .571, 0.5e-3);
}

TEST(PotentialFields, AreRelativeToTheMiddleOfTheMap) {
  FieldOptions options;
  options.centre = {5, -3};
  const std::vector<GroundPoint> objects{{5.15, -3}, {4.85, -3}};
  const PotentialFields fields(objects, {5, -4}, options);
  EXPECT_NEAR(fields.value(right, 0, 1), .7261, digits);
  expect_position(fields.positions(right, 1, 1).at(0), 5, -2.98, 1, digits);
}

TEST(PotentialFields, AreCentredOnTheViewer) {
  const std::vector<GroundPoint> objects{{0, 0}, {0.2, 0}};
  const double expected = fields_of(objects).value(right, 1, 0);
  EXPECT_EQ(PotentialFields(objects, {1, 0}).value(front, 1, 0), expected);
  EXPECT_EQ(PotentialFields(objects, {0, 1}).value(left, 1, 0), expected);
  EXPECT_EQ(PotentialFields(objects, {-1, 0}).value(back, 1, 0), expected);
}

TEST(PotentialFields, LoseAllSidesInACrowd) {
  const auto fields = fields_of({{0, 0}, {0.1, 0}, {0, 0.1}, {0.1, 0.1}});
  for (auto relation : {front, back, left, right}) {
    for (std::size_t target = 0; target < 4; ++target) {
      for (std::size_t landmark = 0; landmark < 4; ++landmark)
        EXPECT_EQ(fields.value(relation, target, landmark), 0);
    }
  }
}

TEST(PotentialFields, GiveNearToTheNearestLandmark) {
  const auto fields = fields_of({{0, 0}, {0.1, 0}, {0.15, 0}});
  EXPECT_EQ(fields.value(near, 1, 0), 0);
  EXPECT_GT(fields.value(near, 1, 2), 0);
}

/// The largest value of all cells around the first object, the landmark.
double highest_over_targets(SpatialRelation relation, std::vector<GroundPoint> objects) {
  double highest = 0;
  objects.emplace_back();
  for (int x = -40; x <= 40; ++x) {
    for (int y = -40; y <= 40; ++y) {
      objects.back() = {objects.front().x + x * 0.01, objects.front().y + y * 0.01};
      highest = std::max(highest, fields_of(objects).value(relation, objects.size() - 1, 0));
    }
  }
  return highest;
}

TEST(PotentialFields, HaveTheirMaximumOneAlsoWhereTheLandmarkIsCovered) {
  for (auto relation : {front, right}) {
    EXPECT_NEAR(highest_over_targets(relation, {{0, 0}, {0.1, 0}, {0, 0.1}}), 1, 1e-12);
    EXPECT_NEAR(highest_over_targets(relation, {{0.9, 0.3}, {0.85, 0.3}}), 1, 1e-12);
  }
}

TEST(PotentialFields, AreNotDisturbedByWhatIsNotOnTheMap) {
  EXPECT_EQ(fields_of({{-0.9, 0}, {-0.97, 0.01}, {-1.3, 0}}).value(left, 1, 0),
            fields_of({{-0.9, 0}, {-0.97, 0.01}}).value(left, 1, 0));
}

TEST(PotentialFields, GiveNothingForWhatIsNotOnTheMap) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto fields = fields_of({{0, 0}, {1.0, 0}, {-1.01, 0}, {nan, 0}, {1e300, 0}});
  for (std::size_t i = 1; i < 5; ++i) {
    for (auto relation : all_spatial_relations) {
      EXPECT_EQ(fields.value(relation, i, 0), 0);
      EXPECT_EQ(fields.value(relation, 0, i), 0);
      EXPECT_EQ(fields.position(relation, i), std::nullopt);
    }
  }
  EXPECT_THROW(fields.value(near, 0, 5), std::out_of_range);
  FieldOptions nothing;
  nothing.map_size = 0;
  EXPECT_THROW(fields_of({}, nothing), std::invalid_argument);
}

} // namespace

} // namespace castor::spatial
