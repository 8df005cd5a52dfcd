#include "castor/mapping/slam/map_frame.hpp"

#include "castor/mapping/geometry/frame_tree.hpp"
#include "castor/mapping/planar/odometry_frame.hpp"
#include "castor/mapping/planar/odometry_history.hpp"
#include "castor/mapping/planar/poses.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace castor::mapping::test {

namespace {

using std::numbers::pi;

TEST(MapFrame, TheRobotIsWhereBothFramesHaveIt) {
  Pose2 in_map{3, 4, 2};
  Pose2 odometry{-1, 7, 0.5};
  geometry::FrameTree frames;
  frames.add(odometry_in_map(in_map, odometry, 1000));
  auto there = frames.transform(
    geometry::Pose{{odometry.x, odometry.y, 0}, {}, geometry::odometry_frame}, "map");
  EXPECT_NEAR(there.position.x, in_map.x, 1e-9);
  EXPECT_NEAR(there.position.y, in_map.y, 1e-9);
}

TEST(MapFrame, TheFrameOfTheOdometryIsWhereTheRobotWasWithoutOdometry) {
  for (const double heading : {-3.0, -0.4, 0.0, 2.0, 3.1}) {
    const auto pose = floor_pose(odometry_in_map({3, 4, heading}, {}, 1000));
    EXPECT_NEAR(pose.x, 3, 1e-9);
    EXPECT_NEAR(pose.y, 4, 1e-9);
    EXPECT_NEAR(normalised(pose.heading - heading), 0, 1e-9);
  }
}

TEST(MapFrame, CovariancesTurnWithTheFrame) {
  PoseCovariance along{4, 0, 0.1, 1, 0.2, 0.5};
  auto quarter = turned(along, pi / 2);
  EXPECT_NEAR(quarter.xx, 1, 1e-9);
  EXPECT_NEAR(quarter.yy, 4, 1e-9);
  EXPECT_NEAR(quarter.xy, 0, 1e-9);
  EXPECT_NEAR(quarter.x_heading, -0.2, 1e-9);
  EXPECT_NEAR(quarter.y_heading, 0.1, 1e-9);
  EXPECT_NEAR(quarter.heading, 0.5, 1e-9);
  auto eighth = turned(along, pi / 4);
  EXPECT_NEAR(eighth.xx + eighth.yy, 5, 1e-9);
  EXPECT_NEAR(eighth.xy, 1.5, 1e-9);
}

TEST(OdometryHistory, IsInterpolated) {
  OdometryHistory history;
  EXPECT_FALSE(history.pose_at(5));
  EXPECT_FALSE(history.newest());
  history.add({10, {1, 0, 0}, {}});
  history.add({20, {2, 0, 1}, {}});
  EXPECT_FALSE(history.pose_at(9));
  EXPECT_FALSE(history.pose_at(21));
  ASSERT_TRUE(history.pose_at(10));
  EXPECT_EQ(history.pose_at(10)->x, 1);
  EXPECT_NEAR(history.pose_at(15)->x, 1.5, 1e-9);
  EXPECT_NEAR(history.pose_at(15)->heading, 0.5, 1e-9);
  EXPECT_EQ(history.pose_at(20)->x, 2);
}

TEST(OdometryHistory, OldOnesAreForgottenAndLateOnesIgnored) {
  OdometryHistory history{2};
  for (std::int64_t i = 0; i < 5; ++i)
    history.add({i, {static_cast<double>(i), 0, 0}, {}});
  history.add({2, {100, 0, 0}, {}});
  EXPECT_FALSE(history.pose_at(2));
  EXPECT_EQ(history.pose_at(3)->x, 3);
  EXPECT_EQ(history.newest()->time, 4);
}

} // namespace

} // namespace castor::mapping::test
