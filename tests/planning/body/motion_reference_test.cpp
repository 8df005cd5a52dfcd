#include "castor/planning/body/motion_reference.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

namespace castor::manipulation {

namespace {

/// One joint that goes on at 1 rad/s for a while.
ArmCommand forward(double begin, double end) {
  ArmCommand result;
  result.motion = 1;
  result.begin = begin;
  result.interval = 0.1;
  for (int i = 0; begin + i * result.interval < end + 1e-9; ++i)
    result.positions.push_back(begin + i * result.interval);
  return result;
}

} // namespace

TEST(MotionReference, RestsWhereTheArmIsWithoutACommand) {
  MotionReference reference({0.5, 1}, 0.8);
  reference.advance(1, true);
  EXPECT_EQ(reference.position(), (Configuration{0.5, 1}));
  EXPECT_EQ(reference.motion(), 0);
}

TEST(MotionReference, ComesToFullSpeedAndToRestInTheStopTime) {
  MotionReference reference({0}, 0.8);
  reference.follow(forward(0, 10));
  for (int i = 0; i < 80; ++i)
    reference.advance(0.01, true);
  EXPECT_NEAR(reference.rate(), 1, 1e-9);
  for (int i = 0; i < 80; ++i)
    reference.advance(0.01, false);
  EXPECT_NEAR(reference.rate(), 0, 1e-9);
  EXPECT_NEAR(reference.position()[0], reference.time(), 1e-9);
}

TEST(MotionReference, NeverGoesBeyondThePartThatIsKnown) {
  MotionReference reference({0}, 0.8);
  reference.follow(forward(0, 2));
  double fastest = 0;
  double before = 0;
  for (int i = 0; i < 1000; ++i) {
    reference.advance(0.01, true);
    const double rate = reference.rate();
    // It brakes no harder than it may.
    EXPECT_GE(rate, before - 0.01 / 0.8 - 0.02);
    before = rate;
    fastest = std::max(fastest, rate);
  }
  EXPECT_GT(fastest, 0.9);
  EXPECT_NEAR(reference.position()[0], 2, 1e-3);
  EXPECT_LE(reference.position()[0], 2);
}

TEST(MotionReference, GoesOnSmoothlyWhereCommandsMeet) {
  MotionReference one({0}, 0.8);
  MotionReference two({0}, 0.8);
  auto whole = forward(-0.2, 10);
  for (auto& x : whole.positions)
    x = std::sin(x);
  one.follow(whole);
  two.follow(whole);
  for (int i = 0; i < 300; ++i) {
    one.advance(0.01, true);
    two.advance(0.01, true);
    if (i % 40 == 0) {
      auto part = forward(std::floor(two.time() / 0.1 - 1) * 0.1, two.time() + 3);
      for (auto& x : part.positions)
        x = std::sin(x);
      two.follow(part);
    }
    EXPECT_NEAR(one.position()[0], two.position()[0], 1e-9) << i;
  }
}

TEST(MotionReference, BeginsAnotherMotionAtRest) {
  MotionReference reference({0}, 0.8);
  reference.follow(forward(0, 10));
  for (int i = 0; i < 80; ++i)
    reference.advance(0.01, true);
  auto other = forward(0, 10);
  other.motion = 2;
  reference.follow(other);
  EXPECT_EQ(reference.rate(), 0);
  EXPECT_EQ(reference.time(), 0);
}

TEST(MotionReference, RefusesACommandOfAnotherArm) {
  MotionReference reference({0, 0}, 0.8);
  ArmCommand command;
  command.positions = {1, 2, 3};
  EXPECT_THROW(reference.follow(command), std::invalid_argument);
  command.positions = {};
  EXPECT_THROW(reference.follow(command), std::invalid_argument);
}

} // namespace castor::manipulation
