// What drivers decide by: keys, corrected poses, and whether the way is free.

#include "castor/mapping/body/corrected_pose.hpp"
#include "castor/mapping/body/free_way.hpp"
#include "castor/mapping/body/key_steering.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace castor::mapping {

namespace {

Odometry odometry_at(std::int64_t milliseconds, const Pose2& pose) {
  return {milliseconds * 1000, pose, {}};
}

LaserScan scan_all_around(float range) {
  LaserScan scan;
  scan.first_angle = -std::numbers::pi;
  scan.angle_step = std::numbers::pi / 180;
  scan.max_range = 12;
  scan.ranges.assign(360, range);
  return scan;
}

} // namespace

TEST(KeySteering, StepsThereAndBack) {
  KeySteering x({});
  x.take("www");
  EXPECT_NEAR(x.velocity().forward, 0.3, 1e-12);
  x.take("sss");
  EXPECT_EQ(x.velocity().forward, 0);
  x.take("wwwwwwwwwwww");
  EXPECT_EQ(x.velocity().forward, 0.6) << "its limit";
  x.take("aad?");
  EXPECT_NEAR(x.velocity().turn, 0.2, 1e-12);
  x.take("x");
  EXPECT_EQ(x.velocity(), (Twist2{0.6, 0}));
  x.take(" ");
  EXPECT_EQ(x.velocity(), Twist2{});
  EXPECT_FALSE(x.is_ended());
  x.take("wq");
  EXPECT_TRUE(x.is_ended());
  EXPECT_EQ(x.velocity(), Twist2{});
}

TEST(KeySteering, TakesArrowsInPieces) {
  KeySteering x({});
  x.take("\x1b[A\x1b");
  x.take("[");
  x.take("D");
  EXPECT_NEAR(x.velocity().forward, 0.1, 1e-12);
  EXPECT_NEAR(x.velocity().turn, 0.2, 1e-12);
  x.take("\x1b[B\x1b[C");
  EXPECT_EQ(x.velocity(), Twist2{});
}

TEST(CorrectedPose, GoesOnByOdometry) {
  CorrectedPose x;
  EXPECT_FALSE(x.now());
  x.add(odometry_at(0, {0, 0, 0}));
  x.add(odometry_at(100, {1, 0, 0}));
  EXPECT_FALSE(x.now()) << "not corrected yet";
  // In the map it was at 10 5, facing along y, halfway between the two.
  x.correct(50'000, {10, 5, std::numbers::pi / 2});
  ASSERT_TRUE(x.now());
  EXPECT_NEAR(x.now()->x, 10, 1e-12);
  EXPECT_NEAR(x.now()->y, 5.5, 1e-12);
  x.add(odometry_at(200, {2, 0, 0}));
  EXPECT_NEAR(x.now()->y, 6.5, 1e-12);
  x.add(odometry_at(150, {7, 7, 0}));
  EXPECT_NEAR(x.now()->y, 6.5, 1e-12) << "that came late";
}

TEST(CorrectedPose, TakesAPoseThatWasToldBeforeItBegan) {
  CorrectedPose early;
  early.correct(5'000'000, {10, 5, 0});
  EXPECT_FALSE(early.now()) << "without odometry";
  early.add(odometry_at(20'000, {1, 0, 0}));
  early.add(odometry_at(20'020, {2, 0, 0}));
  ASSERT_TRUE(early.now());
  EXPECT_NEAR(early.now()->x, 11, 1e-12) << "it stood until the first odometry";
  CorrectedPose late;
  late.add(odometry_at(20'000, {1, 0, 0}));
  late.add(odometry_at(20'020, {2, 0, 0}));
  late.correct(5'000'000, {10, 5, 0});
  EXPECT_EQ(late.now(), early.now());
}

TEST(CorrectedPose, CorrectionWaitsForItsOdometry) {
  CorrectedPose x;
  x.add(odometry_at(21'000, {1, 0, 0}));
  x.correct(30'000'000, {10, 5, 0});
  EXPECT_FALSE(x.now()) << "long after it";
  x.correct(21'100'000, {10, 5, 0});
  ASSERT_TRUE(x.now()) << "odometry is a little late";
  EXPECT_NEAR(x.now()->x, 10, 1e-12);
  x.add(odometry_at(21'050, {2, 0, 0}));
  EXPECT_NEAR(x.now()->x, 10, 1e-12) << "the newest odometry still counts as that of its time";
  x.add(odometry_at(21'150, {4, 0, 0}));
  EXPECT_NEAR(x.now()->x, 11, 1e-12);
  x.add(odometry_at(21'200, {5, 0, 0}));
  EXPECT_NEAR(x.now()->x, 12, 1e-12) << "placed once";
}

TEST(CorrectedPose, TakesNoCorrectionThatItHasForgotten) {
  CorrectedPose x;
  for (int i = 0; i <= 2000; ++i)
    x.add(odometry_at(20 * i, {0.01 * i, 0, 0}));
  x.correct(1'000'000, {10, 5, 0});
  EXPECT_FALSE(x.now());
}

TEST(FreeWay, LooksStraightOnly) {
  auto scan = scan_all_around(3);
  EXPECT_NEAR(free_way(scan, 0.3), 3 * std::cos(std::asin(0.1)), 0.02);
  scan.ranges[180] = 1;
  EXPECT_NEAR(free_way(scan, 0.3), 1, 1e-6);
  scan.ranges[180] = 0;
  scan.ranges[270] = 0.3F;
  EXPECT_GT(free_way(scan, 0.3), 2.9) << "beside it";
  scan.ranges[0] = 0.3F;
  EXPECT_GT(free_way(scan, 0.3), 2.9) << "behind it";
  EXPECT_EQ(free_way(scan_all_around(0), 0.3), 12);
}

TEST(FreeWay, CountsFromTheRobotsMiddle) {
  auto scan = scan_all_around(0);
  scan.mount = {0.2, 0, 0};
  scan.ranges[180] = 1;
  EXPECT_NEAR(free_way(scan, 0.3), 1.2, 1e-6);
}

} // namespace castor::mapping
