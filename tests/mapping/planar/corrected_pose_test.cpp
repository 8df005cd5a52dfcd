#include "castor/mapping/planar/corrected_pose.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <numbers>

namespace castor::mapping {

namespace {

Odometry odometry_at(std::int64_t milliseconds, const Pose2& pose) {
  return {milliseconds * 1000, pose, {}};
}

} // namespace

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
  ASSERT_TRUE(x.odometry_frame());
  EXPECT_NEAR(x.odometry_frame()->y, 4.5, 1e-12);
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

} // namespace castor::mapping
