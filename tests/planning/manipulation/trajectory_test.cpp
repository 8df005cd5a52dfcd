#include "castor/planning/manipulation/trajectory.hpp"

#include "castor/planning/manipulation/kinematics.hpp"
#include "castor/tests/planning/manipulation/katana.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>

namespace castor::manipulation {

namespace {

/// Random waypoints within the limits.
std::vector<Configuration> random_waypoints(const ArmModel& arm, std::uint32_t seed,
                                            std::size_t count) {
  std::mt19937 random(seed);
  std::vector<Configuration> result;
  for (std::size_t i = 0; i < count; ++i)
    result.push_back(random_configuration(arm, random));
  return result;
}

void expect_within_limits(const ArmModel& arm, const JointState& state, double time) {
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_LE(std::abs(state.speeds[i]), arm.joints[i].speed * (1 + 1e-6)) << "at " << time;
    EXPECT_LE(std::abs(state.accelerations[i]), arm.joints[i].acceleration * (1 + 1e-6))
      << "at " << time;
  }
}

} // namespace

TEST(BlendedPath, IsSmoothAtRoundedCornersOnly) {
  const std::vector<Configuration> corners{{0, 0}, {1, 0}, {1, 1}, {2, 1}};
  const BlendedPath path(corners, {0, 0.2, 0, 0});
  ASSERT_EQ(path.pieces().size(), 4u);
  EXPECT_TRUE(path.is_smooth_before(1));
  EXPECT_TRUE(path.is_smooth_before(2));
  EXPECT_FALSE(path.is_smooth_before(3));
  EXPECT_NEAR(path.length(), 3, 1e-12);
  EXPECT_EQ(path.at(-1), corners.front());
  EXPECT_LT(distance(path.at(9), corners.back()), 1e-12);
  // The middle of the parabola is half as far from the corner as the middle of its ends.
  EXPECT_NEAR(distance(path.at(1), corners[1]), std::hypot(0.1, 0.1) / 2, 1e-12);
}

TEST(BlendedPath, RadiiAreNoLongerThanHalfOfTheLines) {
  const BlendedPath path({{0, 0}, {0.1, 0}, {0.1, 5}}, {9, 9, 9});
  EXPECT_NEAR(path.pieces().at(0).end, 0.05, 1e-12);
}

TEST(BlendedPath, WaypointsThatAreEqualCountAsOne) {
  EXPECT_EQ(BlendedPath({{0, 1}, {0, 1}, {0, 1}}, {0, 1, 0}).length(), 0);
  EXPECT_EQ(BlendedPath({{0, 1}, {0, 1}}, {0, 0}).at(0.3), (Configuration{0, 1}));
  EXPECT_THROW(BlendedPath({}, {}), std::invalid_argument);
}

TEST(Trajectory, OfOneJointIsATrapezoidOfItsSpeed) {
  const auto arm = katana();
  const auto& joint = arm.joints[0];
  const Configuration from{-1.5, 0, 0, 0, 0};
  const Configuration to{1.5, 0, 0, 0, 0};
  const auto trajectory = time_parameterise(arm, BlendedPath({from, to}, {0, 0}));
  const double optimum = 3 / joint.speed + joint.speed / joint.acceleration;
  EXPECT_GE(trajectory.duration(), optimum * (1 - 1e-9));
  EXPECT_LT(trajectory.duration(), optimum * 1.01);
  EXPECT_NEAR(trajectory.at(trajectory.duration() / 2).speeds[0], joint.speed, 1e-6);
  EXPECT_EQ(trajectory.at(-1).positions, from);
  EXPECT_EQ(trajectory.at(1e3).positions[0], to[0]);
}

TEST(Trajectory, OfNoMotionTakesNoTime) {
  const auto arm = katana();
  const auto trajectory = time_parameterise(arm, BlendedPath({arm.home, arm.home}, {0, 0}));
  EXPECT_EQ(trajectory.duration(), 0);
  EXPECT_EQ(trajectory.at(0).positions, arm.home);
}

RC_GTEST_PROP(Trajectory, KeepsSpeedsAndAccelerationsOfAllJoints, (std::uint32_t seed)) {
  const auto arm = katana();
  const auto count = *rc::gen::inRange<std::size_t>(2, 8);
  const auto radius = *rc::gen::element(0.0, 0.05, 0.5);
  const BlendedPath path(random_waypoints(arm, seed, count), std::vector<double>(count, radius));
  const auto trajectory = time_parameterise(arm, path);
  for (int i = 0; i <= 1000; ++i) {
    const double time = trajectory.duration() * i / 1000;
    expect_within_limits(arm, trajectory.at(time), time);
  }
  RC_ASSERT(!::testing::Test::HasFailure());
}

RC_GTEST_PROP(Trajectory, MovesAsItsSpeedsSay, (std::uint32_t seed)) {
  const auto arm = katana();
  const auto waypoints = random_waypoints(arm, seed, 4);
  const auto trajectory = time_parameterise(arm, BlendedPath(waypoints, {0, 0.3, 0.3, 0}));
  const double step = 1e-3;
  for (double time = step; time + step < trajectory.duration(); time += 17 * step) {
    const auto before = trajectory.at(time - step);
    const auto state = trajectory.at(time);
    const auto after = trajectory.at(time + step);
    for (std::size_t i = 0; i < 5; ++i) {
      const double most = arm.joints[i].acceleration * step;
      RC_ASSERT(std::abs((after.positions[i] - before.positions[i]) / (2 * step) -
                         state.speeds[i]) <= most);
      RC_ASSERT(std::abs(after.speeds[i] - state.speeds[i]) <= most * (1 + 1e-6));
    }
  }
  RC_ASSERT(distance(trajectory.at(trajectory.duration()).positions, waypoints.back()) < 1e-9);
}

TEST(Trajectory, IsFasterWhereCornersAreRounded) {
  const auto arm = katana();
  const auto waypoints = random_waypoints(arm, 4, 5);
  CollisionChecker empty(arm, {});
  const std::vector<double> none(5, 0);
  const auto stopping = time_parameterise(arm, BlendedPath(waypoints, none));
  const auto rounded = time_parameterise(arm, BlendedPath(waypoints, std::vector<double>(5, 0.3)));
  EXPECT_LT(rounded.duration(), 0.95 * stopping.duration());
}

TEST(Trajectory, CornersAreNotRoundedIntoThings) {
  const auto arm = katana();
  const std::vector<Configuration> waypoints{
    {0.0, 0.8, 0.8, 0.5, 0}, {0.8, 0.8, 0.8, 0.5, 0}, {0.8, 0.0, 0.8, 0.5, 0}};
  // Where the hand would be in the middle of the rounded corner, but not on the lines.
  const auto middle = BlendedPath(waypoints, {0, 0.4, 0}).at(0.8);
  const auto at = tool_pose(arm, middle).position;
  const Scene scene{{thing("the ball", sphere(0.01), at.x, at.y, at.z)}, {}};
  CollisionOptions options;
  options.margin = 0.001;
  // Fingers are where the ball is.
  options.opening = 0;
  CollisionChecker checker(arm, scene, options);
  ASSERT_FALSE(checker.is_free(middle));
  TimingOptions timing;
  timing.blend_radius = 0.4;
  ASSERT_TRUE(checker.is_free_between(waypoints[0], waypoints[1]));
  ASSERT_TRUE(checker.is_free_between(waypoints[1], waypoints[2]));
  const auto trajectory = time_parameterise(arm, checker, waypoints, timing);
  for (int i = 0; i <= 1000; ++i)
    EXPECT_TRUE(checker.is_free(trajectory.at(trajectory.duration() * i / 1000).positions));
}

} // namespace castor::manipulation
