// The metric of the SLAM benchmark, on cases that can be computed by hand.

#include "castor/benchmarks/slam/relations.hpp"

#include "castor/mapping/planar/poses.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace castor::slam_benchmark::test {

namespace {

using mapping::Pose2;
using std::numbers::pi;

constexpr double exact = 1e-9;

TEST(Relations, AreReadFromLines) {
  auto result = parse_relations("# a comment\n\n1.5 2.25 0.5 -0.25 0 0 0 1.5\n", "x.relations");
  ASSERT_TRUE(result.relations);
  ASSERT_EQ(result.relations->size(), 1U);
  EXPECT_EQ(result.relations->front(), (Relation{1500000, 2250000, {0.5, -0.25, 1.5}}));
}

TEST(Relations, LinesThatAreNone) {
  auto result = parse_relations("1 2 0 0 0 0 0 0\n1 2 0 0 0 0 0\n1 2 0 0 nan 0 0 0\n"
                                "1 2 0 0 0 0 0 0 9\n",
                                "x.relations");
  EXPECT_FALSE(result.relations);
  ASSERT_EQ(result.diagnostics.size(), 3U);
  EXPECT_EQ(result.diagnostics[0].where.line(), 2U);
  EXPECT_EQ(result.diagnostics[1].where.line(), 3U);
  EXPECT_EQ(result.diagnostics[2].where.line(), 4U);
  EXPECT_FALSE(parse_relations("# nothing\n", "x").relations);
}

TEST(Relations, StatisticsOfNumbers) {
  auto x = statistics_of({1, 2, 3, 6});
  EXPECT_DOUBLE_EQ(x.mean, 3);
  EXPECT_DOUBLE_EQ(x.deviation, std::sqrt((4. + 1 + 0 + 9) / 3));
  EXPECT_DOUBLE_EQ(x.most, 6);
  EXPECT_EQ(statistics_of({}).mean, 0);
  EXPECT_EQ(statistics_of({5}).deviation, 0);
}

TEST(Relations, APathThatKeepsThemHasNoErrorWhereverItBegins) {
  std::vector<Pose2> truth{{0, 0, 0}, {1, 0, pi / 2}, {1, 2, pi}};
  std::vector<Relation> relations{{0, 1000000, between(truth[0], truth[1])},
                                  {0, 2000000, between(truth[0], truth[2])}};
  Pose2 elsewhere{5, -3, 2};
  std::vector<TimedPose> path;
  for (std::size_t i = 0; i < truth.size(); ++i)
    path.push_back({static_cast<std::int64_t>(i) * 1000000, compose(elsewhere, truth[i])});
  auto errors = relation_errors(path, relations);
  EXPECT_EQ(errors.relations, 2U);
  EXPECT_NEAR(errors.translation.most, 0, exact);
  EXPECT_NEAR(errors.rotation.most, 0, exact);
}

TEST(Relations, ErrorsAreThoseOfTheRelativePose) {
  // The second step is 0.3 too far and 0.4 to the side; the third turns 0.2 too far.
  std::vector<TimedPose> path{{0, {0, 0, 0}}, {10, {1.3, 0.4, 0}}, {1000, {2.3, 0.4, 0.2}}};
  std::vector<Relation> relations{{0, 10, {1, 0, 0}}, {10, 1000, {1, 0, 0}}};
  auto errors = relation_errors(path, relations);
  EXPECT_NEAR(errors.translation.mean, 0.25, exact);
  EXPECT_NEAR(errors.translation.deviation, std::sqrt(2 * 0.0625), exact);
  EXPECT_NEAR(errors.rotation.mean, 0.1, exact);
  EXPECT_NEAR(errors.squared_translation.mean, 0.125, exact);
  EXPECT_NEAR(errors.squared_rotation.mean, 0.02, exact);
}

TEST(Relations, RotationsAreComparedOnTheShorterWay) {
  std::vector<TimedPose> path{{0, {0, 0, 0}}, {1000000, {0, 0, pi - 0.1}}};
  auto errors = relation_errors(path, {{0, 1000000, {0, 0, -pi + 0.1}}});
  EXPECT_NEAR(errors.rotation.mean, 0.2, exact);
}

TEST(Relations, BetweenItsPosesThePathIsInterpolated) {
  std::vector<TimedPose> path{{0, {0, 0, 0}}, {1000000, {2, 0, 1}}};
  auto there = pose_at(path, 250000, 500000);
  ASSERT_TRUE(there);
  EXPECT_NEAR(there->x, 0.5, exact);
  EXPECT_NEAR(there->heading, 0.25, exact);
  // Times in files of relations are rounded.
  EXPECT_EQ(pose_at(path, 999995, 500000), path[1].pose);
  EXPECT_EQ(pose_at(path, 1000005, 500000), path[1].pose);
}

TEST(Relations, TimesOfRelationsMayAllBeOffByTheSame) {
  // Two poses are close in time: the offset tells which is meant.
  std::vector<TimedPose> path{{0, {}},
                              {1000000, {1, 0, 0}},
                              {1000270, {5, 0, 0}},
                              {2000000, {7, 0, 0}},
                              {3000000, {7, 0, 0}}};
  std::vector<Relation> relations{{1000020, 1999750, {2, 0, 0}}, {1999750, 2999750, {0, 0, 0}}};
  EXPECT_EQ(clock_offset(path, relations), 250);
  auto errors = relation_errors(path, relations);
  EXPECT_EQ(errors.relations, 2U);
  EXPECT_NEAR(errors.translation.most, 0, exact);
  EXPECT_EQ(clock_offset(path, {}), 0);
}

TEST(Relations, ThoseOutsideOfThePathAndInGapsAreLeftOut) {
  std::vector<TimedPose> path{{0, {}}, {1000000, {}}, {9000000, {}}};
  EXPECT_FALSE(pose_at(path, -1000, 500000));
  EXPECT_FALSE(pose_at(path, 9001000, 500000));
  EXPECT_FALSE(pose_at(path, 5000000, 500000));
  auto errors = relation_errors(path, {{0, 5000000, {}}, {0, 1000000, {}}});
  EXPECT_EQ(errors.relations, 1U);
  EXPECT_EQ(errors.without_pose, 1U);
}

TEST(Trajectory, IsReadFromLines) {
  auto result = parse_path("# time x y heading\n1 2 3 0.5\n1.5 2 4 0.25\n", "path");
  ASSERT_TRUE(result.path);
  ASSERT_EQ(result.path->size(), 2U);
  EXPECT_EQ(result.path->at(1).time, 1500000);
  EXPECT_EQ(result.path->at(1).pose, (Pose2{2, 4, 0.25}));
  EXPECT_FALSE(parse_path("1 2 3\n", "path").path);
  EXPECT_FALSE(parse_path("", "path").path);
  auto backward = parse_path("2 0 0 0\n1 0 0 0\n", "path");
  ASSERT_EQ(backward.diagnostics.size(), 1U);
  EXPECT_EQ(backward.diagnostics[0].where.line(), 2U);
}

TEST(Trajectory, ARigidMotionOfTheWholeIsNoError) {
  std::vector<TimedPose> truth;
  std::vector<TimedPose> path;
  for (int i = 0; i < 20; ++i) {
    Pose2 x{std::cos(0.3 * i) * i, std::sin(0.5 * i) * 4, 0.1 * i};
    truth.push_back({i * 100000, x});
    path.push_back({i * 100000, compose(Pose2{3, 4, -2.5}, x)});
  }
  auto errors = trajectory_errors(path, truth);
  EXPECT_EQ(errors.poses, 20U);
  EXPECT_NEAR(errors.root_mean_square, 0, exact);
  EXPECT_NEAR(errors.heading_mean, 0, exact);
}

TEST(Trajectory, DistancesFromTheTruth) {
  // Along a line every other pose is off by 0.1 to either side, so that alignment changes nothing.
  std::vector<TimedPose> truth;
  std::vector<TimedPose> path;
  const double aside[]{0.1, -0.1, -0.1, 0.1};
  for (int i = 0; i < 4; ++i) {
    truth.push_back({i, {1. * i, 0, 0}});
    path.push_back({i, {1. * i, aside[i], 0.05}});
  }
  auto errors = trajectory_errors(path, truth);
  EXPECT_NEAR(errors.root_mean_square, 0.1, exact);
  EXPECT_NEAR(errors.median, 0.1, exact);
  EXPECT_NEAR(errors.most, 0.1, exact);
  EXPECT_NEAR(errors.heading_mean, 0.05, exact);
}

} // namespace

} // namespace castor::slam_benchmark::test
