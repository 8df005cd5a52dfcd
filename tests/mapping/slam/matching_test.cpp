// Points of surfaces, and scans that are aligned with them.

#include "castor/mapping/slam/correlative_matcher.hpp"
#include "castor/mapping/slam/point_map.hpp"
#include "castor/mapping/slam/scan_matcher.hpp"
#include "castor/mapping/slam/surface_points.hpp"
#include "castor/tests/mapping/slam/simulated_room.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace castor::mapping::test {

namespace {

double off_by(const Pose2& a, const Pose2& b) {
  auto x = between(a, b);
  return std::hypot(x.x, x.y) + std::abs(x.heading);
}

TEST(SurfacePoints, FaceTheLaser) {
  const std::vector<Wall> walls{{{2, -50}, {2, 50}}};
  auto points = surface_points(scan_from(walls, {0, 0, 0}));
  ASSERT_GT(points.size(), 100U);
  for (const auto& x : points) {
    EXPECT_NEAR(x.position.x, 2, 1e-5);
    if (x.has_normal()) {
      EXPECT_NEAR(x.normal.x, -1, 1e-4);
      EXPECT_NEAR(x.normal.y, 0, 1e-2);
    }
  }
  EXPECT_TRUE(points[points.size() / 2].has_normal());
}

TEST(SurfacePoints, AreWhereTheLaserIsMounted) {
  auto scan = scan_from({{{2, -50}, {2, 50}}}, {0, 0, 0});
  scan.mount = {0.5, 0, 0};
  EXPECT_NEAR(surface_points(scan)[50].position.x, 2.5, 1e-5);
}

TEST(SurfacePoints, BeamsWithoutAnEndAreLeftOut) {
  LaserScan scan;
  scan.angle_step = 0.01;
  scan.ranges = {0,   std::numeric_limits<float>::quiet_NaN(), 1, 0.01F,
                 100, std::numeric_limits<float>::infinity()};
  EXPECT_EQ(surface_points(scan).size(), 1U);
  EXPECT_TRUE(surface_points(LaserScan{}).empty());
}

TEST(SurfacePoints, AnEdgeIsNoSurface) {
  // Two walls, one behind the other: no line leads from one to the other.
  const std::vector<Wall> walls{{{1, 0}, {1, 5}}, {{3, -5}, {3, 0}}};
  for (const auto& x : surface_points(scan_from(walls, {0, 0, 0})))
    if (x.has_normal()) {
      EXPECT_NEAR(x.normal.x, -1, 1e-3);
    }
}

TEST(SurfacePoints, AreThinnedByCells) {
  SurfacePoints points;
  for (int i = 0; i < 100; ++i)
    points.push_back({{0.01 * i, 0}, {0, 1}});
  auto result = thinned(points, 0.1);
  EXPECT_GE(result.size(), 10U);
  EXPECT_LE(result.size(), 11U);
}

TEST(PointMap, FindsWhatABruteForceSearchFinds) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> place{-3, 7};
  std::uniform_real_distribution<double> angle{0, 6.28};
  SurfacePoints points;
  for (int i = 0; i < 500; ++i) {
    auto a = angle(random);
    points.push_back({{place(random), place(random)}, {std::cos(a), std::sin(a)}});
  }
  PointMap map{points};
  for (int i = 0; i < 300; ++i) {
    auto a = angle(random);
    SurfacePoint like{{place(random), place(random)}, {std::cos(a), std::sin(a)}};
    const SurfacePoint* wanted = nullptr;
    for (const auto& x : points)
      if (distance(x.position, like.position) < 0.5 &&
          x.normal.x * like.normal.x + x.normal.y * like.normal.y >= 0.5 &&
          (wanted == nullptr ||
           distance(x.position, like.position) < distance(wanted->position, like.position)))
        wanted = &x;
    const auto* found = map.nearest(like, 0.5);
    ASSERT_EQ(found == nullptr, wanted == nullptr);
    if (found != nullptr) {
      EXPECT_EQ(found->position, wanted->position);
    }
  }
}

TEST(PointMap, LeavesOutPointsThatAreNowhere) {
  PointMap map{{{{1, 1}, {}}, {{std::nan(""), 0}, {1, 0}}}};
  EXPECT_TRUE(map.empty());
  EXPECT_EQ(map.nearest({{1, 1}, {}}, 10), nullptr);
}

class Matching : public ::testing::Test {
protected:
  PointMap map_from(const Pose2& robot) {
    return PointMap{
      transform(robot, surface_points(with_noise(scan_from(walls, robot), 0.01, random)))};
  }

  SurfacePoints seen_from(const Pose2& robot) {
    return surface_points(with_noise(scan_from(walls, robot), 0.01, random));
  }

  std::vector<Wall> walls = furnished_room();
  std::mt19937 random{7};
  ScanMatcher matcher;
};

TEST_F(Matching, AScanFindsItsPlaceFromAGuessNearby) {
  auto map = map_from({2, 1.7, 0.3});
  for (int i = 0; i < 20; ++i) {
    Pose2 truth{2.1 + 0.01 * i, 1.6, 0.25 + 0.01 * i};
    auto guess = compose(truth, {0.15 * std::cos(i), 0.15 * std::sin(i), 0.08 * std::cos(3. * i)});
    auto match = matcher.match(map, seen_from(truth), guess);
    EXPECT_LT(off_by(match.pose, truth), 0.025) << i;
    EXPECT_GT(match.matched, 0.9);
    EXPECT_LT(match.deviation, 0.02);
  }
}

TEST_F(Matching, TheCovarianceIsThatOfTheErrors) {
  auto map = map_from({2, 1.7, 0});
  double squares = 0;
  double expected = 0;
  for (int i = 0; i < 200; ++i) {
    Pose2 truth{2.05, 1.7, 0};
    auto match = matcher.match(map, seen_from(truth), truth);
    squares += (match.pose.y - truth.y) * (match.pose.y - truth.y) / 200;
    expected += match.covariance.yy / 200;
  }
  // The map has noise as well, which all scans meet alike.
  EXPECT_LT(squares, 9 * expected);
  EXPECT_GT(squares, expected / 9);
}

TEST_F(Matching, WithoutKnownPointsTheGuessStays) {
  auto scan = seen_from({2, 1.7, 0});
  EXPECT_EQ(matcher.match(PointMap{}, scan, {1, 2, 3}).pose, (Pose2{1, 2, 3}));
  EXPECT_EQ(matcher.match(PointMap{}, scan, {1, 2, 3}).matched, 0);
  EXPECT_EQ(matcher.match(map_from({2, 1.7, 0}), {}, {1, 2, 3}).matched, 0);
  EXPECT_EQ(matcher.match(map_from({2, 1.7, 0}), scan, {100, 2, 3}).matched, 0);
}

TEST_F(Matching, ACorridorDoesNotTellHowFarOneHasGone) {
  walls = endless_corridor();
  auto map = map_from({0, 0, 0});
  auto match = matcher.match(map, seen_from({0.5, 0, 0}), {0.4, 0.1, 0.05});
  EXPECT_NEAR(match.pose.y, 0, 0.02);
  EXPECT_NEAR(match.pose.heading, 0, 0.01);
  EXPECT_LT(match.observability, 0.02);
  walls = furnished_room();
  auto room = matcher.match(map_from({2, 1.7, 0}), seen_from({2, 1.7, 0}), {2, 1.7, 0});
  EXPECT_GT(room.observability, 0.1);
}

TEST_F(Matching, WhatIsKnownBeforeDecidesInACorridor) {
  walls = endless_corridor();
  auto map = map_from({0, 0, 0});
  auto match = matcher.match(map, seen_from({0.5, 0, 0}), {0.4, 0.1, 0.05}, PosePrior{0.02, 0.1});
  EXPECT_NEAR(match.pose.x, 0.4, 0.05);
  EXPECT_NEAR(match.pose.y, 0, 0.02);
}

TEST_F(Matching, ASearchFindsThePlaceWithoutAGuess) {
  SurfacePoints map;
  for (auto robot : {Pose2{2, 1.7, 0}, Pose2{4, 1.7, 0.5}, Pose2{8, 1.7, 1.5}}) {
    auto points = transform(robot, seen_from(robot));
    map.insert(map.end(), points.begin(), points.end());
  }
  CorrelativeMatcher search{map};
  Pose2 truth{3.2, 1.5, 0.4};
  auto found = search.match(thinned(seen_from(truth), 0.1), {2.2, 2.3, 0}, {1.5, 0.6}, 0.5);
  ASSERT_TRUE(found);
  EXPECT_LT(std::hypot(found->pose.x - truth.x, found->pose.y - truth.y), 0.08);
  EXPECT_NEAR(found->pose.heading, truth.heading, 0.03);
  EXPECT_GT(found->score, 0.6);
}

TEST_F(Matching, ASearchFindsTheBestOfAllPosesOfItsGrid) {
  auto map = transform(Pose2{2, 1.7, 0}, seen_from({2, 1.7, 0}));
  CorrelativeMatcher search{map};
  auto scan = thinned(seen_from({2.3, 1.9, 0.1}), 0.2);
  SearchWindow all{0.4, 0.15};
  auto best = search.match(scan, {2, 1.7, 0}, all, 0);
  ASSERT_TRUE(best);
  // Each pose of the grid alone, in windows of one cell.
  double most = 0;
  for (int dx = -8; dx <= 8; ++dx)
    for (int dy = -8; dy <= 8; ++dy)
      for (int turn = -18; turn <= 18; ++turn) {
        Pose2 pose{2 + 0.05 * dx, 1.7 + 0.05 * dy, turn * 0.05 / 6};
        auto one = search.match(scan, pose, {0, 0}, 0);
        ASSERT_TRUE(one);
        most = std::max(most, one->score);
      }
  EXPECT_NEAR(best->score, most, 1e-9);
}

TEST_F(Matching, ASearchForWhatIsNotThereFindsNothing) {
  CorrelativeMatcher search{transform(Pose2{2, 1.7, 0}, seen_from({2, 1.7, 0}))};
  EXPECT_FALSE(search.match(thinned(seen_from({8, 6.2, 2}), 0.1), {50, 50, 0}, {1, 0.5}, 0.3));
  EXPECT_FALSE(CorrelativeMatcher{{}}.match(seen_from({2, 1.7, 0}), {}, {1, 1}, 0));
  EXPECT_FALSE(search.match({}, {}, {1, 1}, 0));
}

} // namespace

} // namespace castor::mapping::test
