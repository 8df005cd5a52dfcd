#include "castor/mapping/body/differential_drive.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace castor::mapping {

namespace {

constexpr double dt = 0.01;

DriveOptions exact_drive() {
  DriveOptions result;
  result.slip = 0;
  result.diameter_error = 0;
  return result;
}

struct Driven {
  Pose2 pose;
  Pose2 odometry;
};

/// Where a drive at that velocity ends, acceleration included.
Driven drive(DifferentialDrive& x, const Twist2& velocity, double seconds) {
  Driven result;
  x.command(velocity);
  for (int i = 0; i < static_cast<int>(std::lround(seconds / dt)); ++i) {
    auto step = x.step(dt);
    result.pose = compose(result.pose, step.motion);
    result.odometry = compose(result.odometry, step.measured);
  }
  return result;
}

struct Moments {
  double mean = 0;
  double deviation = 0;
};

Moments moments(const std::vector<double>& xs) {
  Moments result;
  for (double x : xs)
    result.mean += x / static_cast<double>(xs.size());
  for (double x : xs)
    result.deviation += (x - result.mean) * (x - result.mean) / static_cast<double>(xs.size());
  result.deviation = std::sqrt(result.deviation);
  return result;
}

} // namespace

TEST(DifferentialDrive, AcceleratesWithinItsLimits) {
  DifferentialDrive x(exact_drive(), 1);
  x.command({5, 0});
  EXPECT_EQ(x.commanded(), (Twist2{0.8, 0})) << "its greatest speed";
  x.step(dt);
  EXPECT_NEAR(x.velocity().forward, 0.008, 1e-12);
  for (int i = 0; i < 99; ++i)
    x.step(dt);
  EXPECT_NEAR(x.velocity().forward, 0.8, 1e-9);
  x.command({});
  x.step(dt);
  EXPECT_NEAR(x.velocity().forward, 0.792, 1e-9) << "it brakes no faster than it accelerates";
}

TEST(DifferentialDrive, DrivesStraightAndTurns) {
  DifferentialDrive x(exact_drive(), 1);
  // 0.4 m/s are reached after 0.5 s; the sum of the steps' velocities is 2 mm more than the
  // integral.
  auto straight = drive(x, {0.4, 0}, 5.5);
  EXPECT_NEAR(straight.pose.x, 0.1 + 2, 0.0021);
  EXPECT_NEAR(straight.pose.y, 0, 1e-12);
  EXPECT_EQ(straight.pose, straight.odometry);
  DifferentialDrive y(exact_drive(), 1);
  auto turned = drive(y, {0, 0.6}, 5.2);
  EXPECT_NEAR(turned.pose.heading, 0.06 + 3, 0.0031);
  EXPECT_NEAR(turned.pose.x, 0, 1e-9);
}

TEST(DifferentialDrive, DrivesInACircle) {
  DifferentialDrive x(exact_drive(), 1);
  drive(x, {0.5, 0.5}, 2);
  // A radius of 1 m: half of a turn is at its other side.
  auto half = drive(x, {0.5, 0.5}, std::numbers::pi / 0.5);
  EXPECT_NEAR(half.pose.x, 0, 0.01);
  EXPECT_NEAR(half.pose.y, 2, 0.01);
}

TEST(DifferentialDrive, TakesWhatIsNoNumberForStop) {
  DifferentialDrive x(exact_drive(), 1);
  x.command({std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()});
  EXPECT_EQ(x.commanded(), Twist2{});
}

TEST(DifferentialDrive, DriftsAsTheRootOfTheWay) {
  auto options = exact_drive();
  options.slip = 0.003;
  for (double seconds : {10.0, 40.0}) {
    std::vector<double> headings;
    std::vector<double> ways;
    double way = 0;
    for (std::uint64_t seed = 0; seed < 400; ++seed) {
      DifferentialDrive x(options, seed);
      auto end = drive(x, {0.5, 0}, seconds);
      way = end.odometry.x;
      headings.push_back(end.pose.heading - end.odometry.heading);
      ways.push_back(std::hypot(end.pose.x, end.pose.y) - way);
    }
    // Each wheel's error has the variance slip^2 * way, and both are independent.
    const double expected = 0.003 * std::sqrt(2 * way) / options.wheel_base;
    auto heading = moments(headings);
    // Four standard errors: of the mean, and of the deviation, which is 1 / sqrt(2 n) of it.
    EXPECT_NEAR(heading.mean, 0, 4 * expected / 20);
    EXPECT_NEAR(heading.deviation / expected, 1, 4 / std::sqrt(800.0)) << way;
    EXPECT_NEAR(moments(ways).deviation, 0.003 * std::sqrt(way / 2), 0.004) << way;
  }
}

TEST(DifferentialDrive, DiametersOfItsWheelsDiffer) {
  auto options = exact_drive();
  options.diameter_error = 0.002;
  std::vector<double> headings;
  double way = 0;
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    DifferentialDrive x(options, seed);
    auto end = drive(x, {0.5, 0}, 10);
    way = end.odometry.x;
    headings.push_back(end.pose.heading);
  }
  const double expected = 0.002 * std::sqrt(2.0) * way / options.wheel_base;
  EXPECT_NEAR(moments(headings).deviation / expected, 1, 4 / std::sqrt(800.0));
}

TEST(DifferentialDrive, IsTheSameForTheSameSeed) {
  auto end = [](std::uint64_t seed) {
    DifferentialDrive x({}, seed);
    return drive(x, {0.5, 0.3}, 5).pose;
  };
  EXPECT_EQ(end(7), end(7));
  EXPECT_NE(end(7), end(8));
}

TEST(DifferentialDrive, BlockedWheelMakesItTurn) {
  DifferentialDrive x(exact_drive(), 1);
  x.block(Wheel::left);
  auto end = drive(x, {0.4, 0}, 2);
  EXPECT_GT(end.pose.heading, 1);
  EXPECT_EQ(end.pose, end.odometry) << "encoders measure that it does not turn";
}

TEST(Noise, IsNormallyDistributed) {
  Noise noise(3);
  std::vector<double> xs;
  int beyond_two = 0;
  for (int i = 0; i < 20000; ++i) {
    xs.push_back(noise.gaussian(2));
    beyond_two += std::abs(xs.back()) > 4;
  }
  auto found = moments(xs);
  EXPECT_NEAR(found.mean, 0, 0.06);
  EXPECT_NEAR(found.deviation, 2, 0.04);
  EXPECT_NEAR(beyond_two / 20000.0, 0.0455, 0.006);
  int happened = 0;
  for (int i = 0; i < 20000; ++i)
    happened += noise.happens(0.1);
  EXPECT_NEAR(happened / 20000.0, 0.1, 0.01);
  EXPECT_FALSE(noise.happens(0));
  EXPECT_TRUE(noise.happens(1));
}

} // namespace castor::mapping
