#include "castor/mapping/map_components/pose_comparison.hpp"

#include <gtest/gtest.h>

namespace castor::mapping {

namespace {

RobotPose pose(std::int64_t time, double x, LocalisationState state) {
  RobotPose result;
  result.time = time;
  result.pose.x = x;
  result.state = state;
  return result;
}

/// The robot drives 1 m/s along the x axis.
void drive(PoseComparison& x, std::int64_t from, std::int64_t to) {
  for (auto time = from; time <= to; time += 20000)
    x.add_truth(time, {static_cast<double>(time) / 1e6, 0, 0});
}

TEST(PoseComparison, ComparesThePosesOfTracking) {
  PoseComparison x;
  drive(x, 0, 1000000);
  x.add_pose(pose(100000, 5, LocalisationState::starting));
  x.add_pose(pose(210000, 0.31, LocalisationState::tracking));
  x.add_pose(pose(310000, 0.33, LocalisationState::tracking));
  x.add_pose(pose(410000, 0.41, LocalisationState::tracking));
  auto error = x.error();
  EXPECT_EQ(error.poses, 4);
  EXPECT_EQ(error.tracking, 3);
  EXPECT_NEAR(error.median, 0.02, 1e-9);
  EXPECT_NEAR(error.most, 0.1, 1e-9);
  EXPECT_EQ(error.last_found, 210000);
  EXPECT_EQ(error.lost, 0);
}

TEST(PoseComparison, WaitsForTheTruth) {
  PoseComparison x;
  x.add_pose(pose(500000, 0.6, LocalisationState::tracking));
  EXPECT_EQ(x.error().poses, 0);
  drive(x, 0, 480000);
  EXPECT_EQ(x.error().poses, 0);
  drive(x, 500000, 500000);
  EXPECT_EQ(x.error().poses, 1);
  EXPECT_NEAR(x.error().most, 0.1, 1e-9);
}

TEST(PoseComparison, CountsHowOftenTheRobotIsLost) {
  PoseComparison x;
  drive(x, 0, 1000000);
  using enum LocalisationState;
  x.add_pose(pose(100000, 0.1, tracking));
  x.add_pose(pose(200000, 0.2, dead_reckoning));
  x.add_pose(pose(300000, 9, lost));
  x.add_pose(pose(400000, 9, lost));
  x.add_pose(pose(500000, 0.5, tracking));
  x.add_pose(pose(600000, 0.6, tracking));
  x.add_pose(pose(700000, 9, lost));
  auto error = x.error();
  EXPECT_EQ(error.lost, 2);
  EXPECT_EQ(error.last_lost, 700000);
  EXPECT_EQ(error.last_found, 500000);
  EXPECT_NEAR(error.most, 0, 1e-9);
}

} // namespace

} // namespace castor::mapping
