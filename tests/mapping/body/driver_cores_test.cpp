// What drivers decide by: keys, and whether the way is free.

#include "castor/mapping/body/free_way.hpp"
#include "castor/mapping/body/key_steering.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace castor::mapping {

namespace {

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
