#include "castor/mapping/body/stall_recovery.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace castor::mapping {

namespace {

constexpr std::int64_t period = 50'000; // microseconds

/// A robot that moves as it is told, and the time.
struct Robot {
  Pose2 pose;
  std::int64_t time = 0;

  void move(const Twist2& velocity) {
    pose = moved(pose, velocity, 1e-6 * period);
    time += period;
  }
};

/// Drives straight on for a metre.
void drive(Robot& robot, StallRecovery& recovery) {
  while (robot.pose.x < 1) {
    robot.move({0.5, 0});
    ASSERT_FALSE(recovery.has_stalled(robot.time, robot.pose, true));
  }
}

TEST(StallRecovery, NoticesARobotThatIsToMoveAndDoesNot) {
  StallOptions options;
  StallRecovery x(options);
  Robot robot;
  drive(robot, x);
  const auto begun = robot.time;
  while (!x.has_stalled(robot.time, robot.pose, true))
    robot.time += period;
  EXPECT_NEAR(static_cast<double>(robot.time - begun), static_cast<double>(options.patience),
              2 * period);
  EXPECT_FALSE(x.has_stalled(robot.time + period, robot.pose, true)) << "told once";
}

TEST(StallRecovery, LetsARobotStandThatIsTo) {
  StallRecovery x;
  Robot robot;
  drive(robot, x);
  for (int i = 0; i < 1000; ++i)
    EXPECT_FALSE(x.has_stalled(robot.time += period, robot.pose, false));
}

TEST(StallRecovery, LetsARobotTurnOnTheSpot) {
  StallRecovery x;
  Robot robot;
  for (int i = 0; i < 200; ++i) {
    robot.move({0, 0.5});
    EXPECT_FALSE(x.has_stalled(robot.time, robot.pose, true));
  }
}

TEST(StallRecovery, GoesBackAlongTheTrailLookingWhereItGoes) {
  StallRecovery x;
  Robot robot;
  drive(robot, x);
  ASSERT_TRUE(x.begin(robot.time, robot.pose));
  EXPECT_TRUE(x.is_active());
  while (const auto velocity = x.velocity(robot.time, robot.pose)) {
    EXPECT_GE(velocity->forward, 0);
    robot.move(*velocity);
  }
  EXPECT_FALSE(x.is_active());
  EXPECT_NEAR(robot.pose.x, 0.5, 0.15);
  EXPECT_NEAR(robot.pose.y, 0, 0.1);
  EXPECT_GT(std::abs(robot.pose.heading), 2.5);
}

TEST(StallRecovery, EndsInTimeWhereTheWayBackIsBlocked) {
  StallOptions options;
  StallRecovery x(options);
  Robot robot;
  drive(robot, x);
  const auto begun = robot.time;
  ASSERT_TRUE(x.begin(robot.time, robot.pose));
  while (x.velocity(robot.time, robot.pose))
    robot.time += period;
  EXPECT_LE(robot.time - begun, options.longest);
}

TEST(StallRecovery, HasNoWayBackAtTheStart) {
  StallRecovery x;
  EXPECT_FALSE(x.has_stalled(0, {}, true));
  EXPECT_FALSE(x.begin(0, {}));
}

TEST(StallRecovery, TrailMovesWithACorrectionOfThePose) {
  StallRecovery x;
  Robot robot;
  drive(robot, x);
  robot.pose.y += 1;
  EXPECT_FALSE(x.has_stalled(robot.time, robot.pose, true));
  ASSERT_TRUE(x.begin(robot.time, robot.pose));
  while (const auto velocity = x.velocity(robot.time, robot.pose))
    robot.move(*velocity);
  EXPECT_NEAR(robot.pose.x, 0.5, 0.15);
  EXPECT_NEAR(robot.pose.y, 1, 0.1);
}

} // namespace

} // namespace castor::mapping
