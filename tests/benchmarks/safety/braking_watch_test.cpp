// When a robot brakes, and how far it gets, from what its body says.

#include "castor/benchmarks/safety/braking_watch.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>

namespace castor::benchmark {

namespace {

/// Says what a robot with 0.5 m/s does that begins to brake then, with 0.8 m/s^2, times in ms.
void drive(BrakingWatch& watch, std::int64_t begin, std::int64_t brakes, std::int64_t end) {
  mapping::BodyStatus x;
  for (auto now = begin; now <= end; now += 10) {
    x.time = now * 1000;
    x.velocity.forward = std::clamp(0.5 - 0.0008 * static_cast<double>(now - brakes), 0.0, 0.5);
    x.driven += x.velocity.forward * 0.01;
    watch.add(x);
  }
}

} // namespace

TEST(BrakingWatch, TellsWhenTheRobotBeginsToBrakeAndStood) {
  BrakingWatch watch;
  drive(watch, 0, 700, 2000);
  const auto stop = watch.await_stop(500'000, 0.8);
  EXPECT_NEAR(stop.braked_ms, 200, 1);
  EXPECT_NEAR(stop.stood_ms, 200 + 625, 10);
  EXPECT_NEAR(stop.way, 0.5 * 0.2 + 0.25 / 1.6, 0.01);
}

TEST(BrakingWatch, TimesAreThoseOfTheRobot) {
  BrakingWatch watch;
  // All of that arrives at once.
  drive(watch, 0, 1000, 3000);
  EXPECT_NEAR(watch.await_stop(1'000'000, 0.8).braked_ms, 0, 1);
}

TEST(BrakingWatch, StopBeforeTheFailureDoesNotCount) {
  BrakingWatch watch;
  drive(watch, 0, 100, 1000);
  drive(watch, 2000, 2700, 4000);
  EXPECT_NEAR(watch.await_stop(2'500'000, 0.8).braked_ms, 200, 1);
}

} // namespace castor::benchmark
