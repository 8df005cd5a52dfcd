// When the pose of a robot is told again.

#include "castor/mapping/planar/poses.hpp"
#include "castor/mapping/slam/pose_news.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <random>

namespace castor::mapping::test {

namespace {

RobotPose pose_at(std::int64_t milliseconds, const Pose2& pose) {
  RobotPose x;
  x.time = milliseconds * 1000;
  x.pose = pose;
  x.state = LocalisationState::tracking;
  return x;
}

/// Asks for the pose, and notes that it was told if it is news.
bool tells(PoseNews& news, const RobotPose& x, const Pose2& odometry) {
  if (!news.is_news(x, odometry))
    return false;
  news.told(x, odometry);
  return true;
}

} // namespace

TEST(PoseNews, SaysNothingOfARobotThatStands) {
  PoseNews news;
  std::mt19937 random{1};
  // Three deviations of a scan in a room.
  std::uniform_real_distribution<double> noise{-0.0015, 0.0015};
  const Pose2 odometry{3, 4, 1};
  EXPECT_TRUE(tells(news, pose_at(0, {1, 2, 0.5}), odometry)) << "the first";
  for (int i = 1; i < 600; ++i)
    EXPECT_FALSE(
      tells(news, pose_at(100 * i, {1 + noise(random), 2 + noise(random), 0.5 + noise(random)}),
            odometry))
      << i;
}

TEST(PoseNews, TellsEachPeriodOfARobotThatDrives) {
  PoseNews news;
  int told = 0;
  for (int i = 0; i < 100; ++i) {
    const Pose2 pose{0.025 * i, 0, 0};
    told += tells(news, pose_at(50 * i, pose), pose) ? 1 : 0;
  }
  EXPECT_EQ(told, 50);
}

TEST(PoseNews, TellsOfARobotThatCreeps) {
  PoseNews news;
  double told_at = 0;
  for (int i = 0; i < 1000; ++i) {
    const Pose2 pose{0.0001 * i, 0, 0};
    if (tells(news, pose_at(100 * i, pose), pose))
      told_at = pose.x;
    EXPECT_LT(pose.x - told_at, 0.0011) << i;
  }
}

TEST(PoseNews, TellsOfWheelsThatSpinAndOfARobotThatIsPushed) {
  PoseNews news;
  EXPECT_TRUE(tells(news, pose_at(0, {}), {}));
  EXPECT_TRUE(tells(news, pose_at(100, {}), {0.1, 0, 0})) << "the wheels spin";
  EXPECT_FALSE(tells(news, pose_at(200, {}), {0.1, 0, 0}));
  EXPECT_TRUE(tells(news, pose_at(300, {0.05, 0, 0}), {0.1, 0, 0})) << "it is pushed";
  EXPECT_FALSE(tells(news, pose_at(400, {0.05, 0, 0}), {0.1, 0, 0}));
  EXPECT_TRUE(tells(news, pose_at(500, {0.05, 0, 0.01}), {0.1, 0, 0})) << "it is turned";
}

TEST(PoseNews, TellsOfAnotherStateAtOnce) {
  PoseNews news;
  EXPECT_TRUE(tells(news, pose_at(0, {}), {}));
  auto lost = pose_at(10, {});
  lost.state = LocalisationState::dead_reckoning;
  lost.reason = "no scan comes";
  EXPECT_TRUE(tells(news, lost, {}));
  lost.time = 1'000'000;
  EXPECT_FALSE(tells(news, lost, {}));
  lost.reason = "no odometry comes";
  EXPECT_TRUE(tells(news, lost, {}));
}

} // namespace castor::mapping::test
