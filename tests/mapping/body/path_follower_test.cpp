#include "castor/mapping/body/path_follower.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numbers>
#include <vector>

namespace castor::mapping {

namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

/// Largest distance from the path, and from its end at last, of a robot that obeys at once.
struct Drive {
  double off_path = 0;
  double off_end = 0;
  double seconds = 0;
};

Drive follow(const Path& path, Pose2 pose, const FollowOptions& options = {}) {
  PathFollower follower(path, options);
  Drive result;
  for (int i = 0; i < 20000 && !follower.has_arrived(); ++i) {
    pose = moved(pose, follower.velocity_at(pose), 0.05);
    double off = std::numeric_limits<double>::infinity();
    for (std::size_t k = 1; k < path.size(); ++k)
      for (int s = 0; s <= 200; ++s)
        off = std::min(off, distance(Point2{std::lerp(path[k - 1].x, path[k].x, s / 200.0),
                                            std::lerp(path[k - 1].y, path[k].y, s / 200.0)},
                                     {pose.x, pose.y}));
    result.off_path = std::max(result.off_path, off);
    result.seconds += 0.05;
  }
  EXPECT_TRUE(follower.has_arrived());
  result.off_end = distance(path.back(), {pose.x, pose.y});
  EXPECT_EQ(follower.velocity_at(pose), Twist2{});
  return result;
}

} // namespace

TEST(PathText, ReadsLinesAndCommas) {
  auto read = parse_path("# around\n1 2\n3m 250cm, -4 5\n\n-4 5 # again\n", "x.path");
  EXPECT_THAT(read.problems, IsEmpty());
  EXPECT_THAT(read.path, ElementsAre(Point2{1, 2}, Point2{3, 2.5}, Point2{-4, 5}));
  EXPECT_THAT(parse_path("1 2,3 4", "").path, SizeIs(2));
}

TEST(PathText, ReportsAllProblems) {
  auto read = parse_path("1 2\n3\n4 x\n1 2 3\n", "x.path");
  EXPECT_THAT(read.problems, SizeIs(3));
  EXPECT_EQ(read.problems[0].where.line(), 2u);
  EXPECT_THAT(parse_path("# nothing\n", "x.path").problems, SizeIs(1));
}

TEST(PathFollower, FollowsAStraightPath) {
  auto drive = follow({{0, 0}, {5, 0}}, {0, 0.3, 0});
  EXPECT_LT(drive.off_end, 0.11);
  EXPECT_LE(drive.off_path, 0.31);
  EXPECT_LT(drive.seconds, 20);
}

TEST(PathFollower, CutsCornersOnlyALittle) {
  auto drive = follow({{0, 0}, {3, 0}, {3, 3}, {0, 3}, {0, 0.5}}, {});
  EXPECT_LT(drive.off_end, 0.11);
  EXPECT_LT(drive.off_path, 0.2);
}

TEST(PathFollower, TurnsOnTheSpotFirst) {
  PathFollower follower({{0, 0}, {5, 0}}, {});
  auto velocity = follower.velocity_at({0, 0, std::numbers::pi - 0.1});
  EXPECT_EQ(velocity.forward, 0);
  EXPECT_LT(velocity.turn, -1);
}

TEST(PathFollower, TakesNoShortCutWhereThePathCrossesItself) {
  // Around a square, over its start, and on: the whole way has to be driven.
  const Path path{{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}, {4, 0}};
  auto drive = follow(path, {});
  EXPECT_LT(drive.off_end, 0.11);
  EXPECT_GT(drive.seconds, 20 / 0.5);
}

TEST(PathFollower, GoesOnWhereAnotherOneWas) {
  const Path path{{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}};
  PathFollower x(path, {});
  x.resume(10);
  // In the middle of the third side, it drives on along it, to the left.
  auto velocity = x.velocity_at({2, 4, std::numbers::pi});
  EXPECT_GT(velocity.forward, 0.4);
  EXPECT_NEAR(velocity.turn, 0, 0.01);
  EXPECT_NEAR(x.done(), 10, 0.03);
}

TEST(PathFollower, ArrivesAtASinglePoint) {
  EXPECT_LT(follow({{2, 1}}, {}).off_end, 0.11);
}

TEST(PathFollower, FindsTheSmallestShiftWithWhichThePathIsFree) {
  PathFollower x({{0, 0}, {10, 0}}, {});
  x.resume(2);
  const std::vector<Point2> nothing;
  EXPECT_EQ(x.free_shift(nothing, 0.3, 1, 0.3), 0);
  // To its left, 0.1 m too near; that to the right leaves room.
  const std::vector<Point2> left{{2.5, 0.2}, {2.7, -0.5}};
  EXPECT_NEAR(x.free_shift(left, 0.3, 1, 0.3).value(), -0.1, 0.021);
  const std::vector<Point2> gap{{2.5, 0.2}, {2.7, -0.35}};
  EXPECT_FALSE(x.free_shift(gap, 0.3, 1, 0.3)) << "too narrow";
  EXPECT_EQ(x.free_shift(std::vector<Point2>{{3.5, 0.1}}, 0.3, 1, 0.3), 0) << "further on";
  const auto velocity = x.velocity_at({2, 0, 0}, 0.1);
  EXPECT_GT(velocity.turn, 0.1);
}

} // namespace castor::mapping
