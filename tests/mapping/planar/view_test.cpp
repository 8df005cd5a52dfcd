#include "castor/mapping/planar/view.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <numbers>

namespace castor::mapping::test {

namespace {

/// 181 beams forwards that end in 4 m.
LaserScan uniform_scan() {
  LaserScan result;
  result.first_angle = -std::numbers::pi / 2;
  result.angle_step = std::numbers::pi / 180;
  result.max_range = 30;
  result.ranges.assign(181, 4);
  return result;
}

View view_of(const LaserScan& scan, const Pose2& robot) {
  return {std::make_shared<const LaserScan>(scan), robot};
}

TEST(View, PassesWhatBeamsEndBehind) {
  const auto view = view_of(uniform_scan(), {});
  EXPECT_TRUE(view.passes({2, 0}, 0.3));
  EXPECT_TRUE(view.passes({2, 2}, 0.3));
  EXPECT_TRUE(view.passes({3.6, 0}, 0.3));
  EXPECT_FALSE(view.passes({3.8, 0}, 0.3));
  EXPECT_FALSE(view.passes({5, 0}, 0.3));
}

TEST(View, KnowsNothingOutsideOfTheScan) {
  EXPECT_FALSE(view_of(uniform_scan(), {}).passes({-2, 0}, 0.3));
}

TEST(View, KnowsNothingWhereNothingCameBackOrABeamBesideEnds) {
  auto scan = uniform_scan();
  scan.ranges[91] = 0;
  EXPECT_FALSE(view_of(scan, {}).passes({2, 0}, 0.3));
  scan.ranges[91] = 2.1F;
  EXPECT_FALSE(view_of(scan, {}).passes({2, 0}, 0.3));
  scan.ranges[91] = 2.5F;
  EXPECT_TRUE(view_of(scan, {}).passes({2, 0}, 0.3));
}

TEST(View, IsFromWhereTheScannerIsOnTheRobot) {
  auto scan = uniform_scan();
  scan.mount = {0.5, 0, 0};
  const auto view = view_of(scan, {10, 20, std::numbers::pi / 2});
  EXPECT_TRUE(view.passes({10, 24}, 0.3));
  EXPECT_FALSE(view.passes({10, 24.4}, 0.3));
  EXPECT_FALSE(view.passes({10, 20.2}, 0.3));
}

} // namespace

} // namespace castor::mapping::test
