#include "castor/perception/spatial/camera_directions.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace castor::spatial {

namespace {

using enum SpatialRelation;

/// Above (0, -1), looking north and down by 45 degrees: a turn about x by 135 degrees brings z
/// there and y to the image's lower edge.
geometry::Pose from_the_south() {
  const double half = 3 * std::acos(-1.0) / 8;
  return {{0, -1, 1}, {std::cos(half), -std::sin(half), 0, 0}};
}

TEST(CameraDirections, AreThoseOfTheViewer) {
  const auto directions = ground_directions(from_the_south());
  ASSERT_TRUE(directions);
  EXPECT_NEAR(directions->back.y, 1, 1e-12);
  EXPECT_NEAR(directions->front.y, -1, 1e-12);
  EXPECT_NEAR(directions->right.x, 1, 1e-12);
  EXPECT_NEAR(directions->left.x, -1, 1e-12);
}

TEST(CameraDirections, AreNoneStraightFromAbove) {
  EXPECT_FALSE(ground_directions({{0, 0, 1}, {0, 1, 0, 0}}));
}

TEST(CameraDirections, AreThoseOfTheImageStraightFromAbove) {
  const double half = std::sqrt(0.5);
  // The image's right edge is at x, its upper one at y; then turned by 90 degrees.
  auto directions = viewing_directions({{0, 0, 1}, {0, 1, 0, 0}});
  ASSERT_TRUE(directions);
  EXPECT_NEAR(directions->right.x, 1, 1e-12);
  EXPECT_NEAR(directions->back.y, 1, 1e-12);
  directions = viewing_directions({{0, 0, 1}, {0, half, half, 0}});
  ASSERT_TRUE(directions);
  EXPECT_NEAR(directions->right.y, 1, 1e-12);
  EXPECT_NEAR(directions->back.x, -1, 1e-12);
}

TEST(CameraDirections, AreTowardsTheTableIfOnlyThePlaceIsKnown) {
  const auto directions = viewing_directions({{2, 0, 0.5}, {}});
  ASSERT_TRUE(directions);
  EXPECT_NEAR(directions->back.x, -1, 1e-12);
  EXPECT_NEAR(directions->right.y, 1, 1e-12);
  EXPECT_FALSE(viewing_directions({{0, 0, 0.5}, {}}));
}

TEST(CameraDirections, TurnPointsAsTheyAreSeen) {
  const auto from_south = as_seen(*viewing_directions(from_the_south()), {0.3, 2});
  EXPECT_NEAR(from_south.x, 0.3, 1e-12);
  EXPECT_NEAR(from_south.y, 2, 1e-12);
  const auto from_east = as_seen(*viewing_directions({{1, 0, 1}, {}}), {0.3, 2});
  EXPECT_NEAR(from_east.x, 2, 1e-12);
  EXPECT_NEAR(from_east.y, -0.3, 1e-12);
}

TEST(CameraDirections, RelateThingsWhateverTheirDistance) {
  const auto directions = *ground_directions(from_the_south());
  EXPECT_NEAR(distance_to_side(directions, right, {0.3, 2}, {0.1, -1}), 0.2, 1e-12);
  EXPECT_TRUE(is_on_side(directions, right, {0.3, 2}, {0.1, -1}));
  EXPECT_FALSE(is_on_side(directions, right, {0.3, 2}, {0.1, -1}, 0.25));
  EXPECT_TRUE(is_on_side(directions, back, {0.3, 2}, {0.1, -1}));
  EXPECT_FALSE(is_on_side(directions, front, {0.3, 2}, {0.1, -1}));
  EXPECT_FALSE(is_on_side(directions, left, {0.3, 2}, {0.1, -1}));
}

} // namespace

} // namespace castor::spatial
