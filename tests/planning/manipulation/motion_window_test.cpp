#include "castor/planning/manipulation/motion_window.hpp"

#include "castor/tests/planning/manipulation/katana.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace castor::manipulation {

namespace {

Trajectory motion(const ArmModel& arm) {
  auto to = arm.home;
  to[0] += 1;
  return time_parameterise(arm, BlendedPath({arm.home, to}, {0, 0}));
}

} // namespace

TEST(MotionWindow, HasThePartAroundThatTime) {
  const auto arm = katana();
  const auto trajectory = motion(arm);
  const auto window = motion_window(trajectory, 7, 0.5);
  EXPECT_EQ(window.motion, 7);
  const auto count = window.positions.size() / arm.home.size();
  const double end = window.begin + window.interval * static_cast<double>(count - 1);
  EXPECT_LE(window.begin, 0.5 - 0.12);
  EXPECT_GE(end, 0.5 + 1.6);
  for (std::size_t i = 0; i < count; ++i)
    EXPECT_DOUBLE_EQ(
      window.positions[i * arm.home.size()],
      trajectory.at(window.begin + window.interval * static_cast<double>(i)).positions[0]);
}

TEST(MotionWindow, IsSampledAtTheSameTimesAsOthersOfTheMotion) {
  const auto trajectory = motion(katana());
  for (const double time : {0.0, 0.013, 0.2, 0.37}) {
    const auto window = motion_window(trajectory, 1, time);
    EXPECT_NEAR(std::remainder(window.begin, window.interval), 0, 1e-9);
  }
}

TEST(MotionWindow, RestsBeforeAndAfterTheMotion) {
  const auto arm = katana();
  const auto trajectory = motion(arm);
  const auto window = motion_window(trajectory, 1, trajectory.duration());
  EXPECT_DOUBLE_EQ(window.positions[window.positions.size() - arm.home.size()], arm.home[0] + 1);
  EXPECT_DOUBLE_EQ(motion_window(trajectory, 1, 0).positions[0], arm.home[0]);
}

} // namespace castor::manipulation
