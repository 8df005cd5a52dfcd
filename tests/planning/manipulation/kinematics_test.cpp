#include "castor/planning/manipulation/kinematics.hpp"

#include "castor/mapping/geometry/poses.hpp"
#include "castor/planning/manipulation/closed_form_kinematics.hpp"
#include "castor/planning/manipulation/inverse_kinematics.hpp"
#include "castor/planning/manipulation/kinematic_chain.hpp"
#include "castor/tests/planning/manipulation/katana.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

namespace castor::manipulation {

namespace {

using std::numbers::pi;

/// How far a configuration brings the tool from a pose: metres or radians, what is more.
double error_of(const ArmModel& arm, const Configuration& configuration, const Pose& tool) {
  const auto reached = tool_pose(arm, configuration);
  return std::max(geometry::distance(reached.position, tool.position),
                  geometry::angle_between(reached.rotation, tool.rotation));
}

rc::Gen<Configuration> configurations(const ArmModel& arm) {
  return rc::gen::map(rc::gen::arbitrary<std::uint32_t>(), [arm](std::uint32_t seed) {
    std::mt19937 random(seed);
    return random_configuration(arm, random);
  });
}

/// The tool straight down.
Pose from_above(double x, double y, double z, double heading = 0) {
  return {{x, y, z},
          geometry::compose(geometry::rotation_about_z(heading), geometry::Rotation{0, 0, 1, 0}),
          arm_frame};
}

/// angle_between() takes a cosine and knows no angle below 1e-8.
constexpr double angle_precision = 5e-8;

} // namespace

TEST(Kinematics, TheKatanaStandsUprightWithAllJointsAtZero) {
  const auto tool = tool_pose(katana(), std::vector<double>(5, 0));
  EXPECT_NEAR(tool.position.x, 0, 1e-12);
  EXPECT_NEAR(tool.position.z, 0.2015 + 0.19 + 0.139 + 0.1473 + 0.166, 1e-12);
}

TEST(Kinematics, PitchJointsLeanTheArmForward) {
  const auto tool = tool_pose(katana(), std::vector<double>{pi / 2, 0.3, 0.4, 0.5, 0});
  const double r = 0.19 * std::sin(0.3) + 0.139 * std::sin(0.7) + 0.3133 * std::sin(1.2);
  EXPECT_NEAR(tool.position.x, 0, 1e-12);
  EXPECT_NEAR(tool.position.y, r, 1e-12);
  EXPECT_NEAR(tool.position.z,
              0.2015 + 0.19 * std::cos(0.3) + 0.139 * std::cos(0.7) + 0.3133 * std::cos(1.2),
              1e-12);
}

TEST(Kinematics, SlidesMoveAlongTheirAxis) {
  const auto arm =
    parse_arm("arm a\nslide s moves l at 1 0 0 turned 0 90 0 axis z from 0 to 1 speed 1 "
              "acceleration 1\nshape sphere 0.1\ntool at 0 0 0.5\n",
              "a.arm")
      .arm;
  const auto tool = tool_pose(arm, std::vector{0.25});
  EXPECT_NEAR(tool.position.x, 1.75, 1e-12);
  EXPECT_NEAR(tool.position.z, 0, 1e-12);
  EXPECT_EQ(link_poses(arm, std::vector{0.25}).size(), 2u);
}

TEST(Kinematics, RefusesAConfigurationOfAnotherArm) {
  EXPECT_THROW(tool_pose(katana(), std::vector<double>(4, 0)), std::invalid_argument);
  EXPECT_THROW(InverseKinematics(katana()).solve({}, {0}), std::invalid_argument);
}

RC_GTEST_PROP(ClosedFormKinematics, OneCandidateIsTheConfigurationThatThePoseIsFrom, ()) {
  const auto arm = katana();
  const auto configuration = *configurations(arm);
  const auto candidates = ClosedFormKinematics::of(arm)->candidates(tool_pose(arm, configuration));
  double nearest = 10;
  for (const auto& x : candidates)
    nearest = std::min(nearest, distance(x.configuration, configuration));
  RC_ASSERT(nearest < 1e-6);
}

RC_GTEST_PROP(ClosedFormKinematics, EveryCandidateHasThePositionAndTheTilt, ()) {
  const auto arm = katana();
  const auto tool = tool_pose(arm, *configurations(arm));
  const auto up_of = [](const Pose& pose) { return geometry::rotate(pose.rotation, {0, 0, 1}).z; };
  for (const auto& x : ClosedFormKinematics::of(arm)->candidates(tool)) {
    const auto reached = tool_pose(arm, x.configuration);
    RC_ASSERT(geometry::distance(reached.position, tool.position) < 1e-9);
    RC_ASSERT(std::abs(up_of(reached) - up_of(tool)) < 1e-9);
    RC_ASSERT(x.has_rotation == (geometry::angle_between(reached.rotation, tool.rotation) < 1e-6));
    RC_ASSERT(x.is_within_limits == within_limits(arm, x.configuration));
  }
}

TEST(ClosedFormKinematics, ThereAreEightCandidatesWhereBothTiltsAreNearEnough) {
  // Tilted a little: outwards and inwards, and for each both turret and elbow.
  const Pose tool{{0.02, 0, 0.55}, {std::cos(0.1), 0, std::sin(0.1), 0}, arm_frame};
  const auto candidates = ClosedFormKinematics::of(katana())->candidates(tool);
  ASSERT_EQ(candidates.size(), 8u);
  std::set<std::vector<int>> different;
  for (const auto& x : candidates) {
    std::vector<int> rounded;
    for (auto angle : x.configuration)
      rounded.push_back(static_cast<int>(std::lround(angle * 1000)));
    different.insert(rounded);
  }
  EXPECT_EQ(different.size(), 8u);
  EXPECT_EQ(std::ranges::count_if(candidates, [](auto& x) { return x.has_rotation; }), 4);
}

TEST(ClosedFormKinematics, GraspsFromAboveWithAnyHeading) {
  const auto arm = katana();
  const InverseKinematics inverse(arm);
  for (double heading : {0.0, 0.5, -1.2, 2.0}) {
    const auto tool = from_above(0.2, 0.1, 0.03, heading);
    const auto solutions = inverse.solve(tool, arm.home);
    ASSERT_FALSE(solutions.empty()) << heading;
    EXPECT_LT(error_of(arm, solutions.front(), tool), angle_precision);
  }
}

TEST(ClosedFormKinematics, ARollThatStandsStillIsNearlyRight) {
  const auto roll = [](const ArmModel& arm, double heading) {
    std::vector<double> result;
    for (const auto& x :
         InverseKinematics(arm).solve(from_above(0.25, 0.1, 0.1, heading), arm.home))
      result.push_back(x.back());
    return result;
  };
  const auto arm = katana();
  for (double heading = 0; heading < 2 * pi; heading += 0.2)
    for (const double wanted : roll(arm, heading)) {
      const auto near = roll(with_still_joint(arm, 4, wanted + 0.05), heading);
      EXPECT_TRUE(std::ranges::count(near, wanted + 0.05) > 0) << heading;
      for (const double x : roll(with_still_joint(arm, 4, wanted + 0.2), heading))
        EXPECT_EQ(x, wanted + 0.2) << heading;
    }
  // A turret that is nearly right would put the tool elsewhere.
  const auto turret = roll(with_still_joint(arm, 0, std::atan2(0.1, 0.25) + 0.05), 0);
  EXPECT_TRUE(turret.empty());
}

TEST(ClosedFormKinematics, HasNoSolutionBeyondTheArmsReach) {
  const auto arm = katana();
  EXPECT_TRUE(ClosedFormKinematics::of(arm)->candidates(from_above(0.7, 0, 0.1)).empty());
}

TEST(ClosedFormKinematics, HasNoRotationOutOfTheArmsPlane) {
  // Horizontal, to the left of where the arm points.
  const Pose tool{{0.35, 0, 0.3}, {0.5, -0.5, 0.5, 0.5}, arm_frame};
  ASSERT_NEAR(geometry::rotate(tool.rotation, {0, 0, 1}).y, 1, 1e-9);
  const auto arm = katana();
  EXPECT_FALSE(ClosedFormKinematics::of(arm)->candidates(tool).empty());
  EXPECT_TRUE(InverseKinematics(arm).solve(tool, arm.home).empty());
}

TEST(ClosedFormKinematics, IsForArmsLikeTheKatanaOnly) {
  EXPECT_FALSE(ClosedFormKinematics::of(six_joints()));
  EXPECT_FALSE(InverseKinematics(six_joints()).is_closed_form());
  auto arm = katana();
  EXPECT_TRUE(ClosedFormKinematics::of(arm));
  arm.joints[2].origin.position.x = 0.01;
  EXPECT_FALSE(ClosedFormKinematics::of(arm));
}

TEST(ClosedFormKinematics, KnowsAxesThatPointTheOtherWay) {
  auto arm = katana();
  for (auto index : {0, 2, 4}) {
    arm.joints[static_cast<std::size_t>(index)].axis.y *= -1;
    arm.joints[static_cast<std::size_t>(index)].axis.z *= -1;
  }
  const Configuration configuration{0.4, 0.3, -0.9, -0.7, 0.2};
  const auto tool = tool_pose(arm, configuration);
  const auto solutions = InverseKinematics(arm).solve(tool, configuration);
  ASSERT_FALSE(solutions.empty());
  EXPECT_LT(distance(solutions.front(), configuration), 1e-9);
}

RC_GTEST_PROP(InverseKinematics, TheNearestSolutionIsFirst, ()) {
  const auto arm = katana();
  const auto near = *configurations(arm);
  const auto solutions = InverseKinematics(arm).solve(tool_pose(arm, *configurations(arm)), near);
  RC_ASSERT(!solutions.empty());
  for (const auto& x : solutions) {
    RC_ASSERT(within_limits(arm, x));
    RC_ASSERT(distance(solutions.front(), near) <= distance(x, near));
  }
}

TEST(DampedLeastSquares, SolvesPosesThatAnArmOfSixJointsReaches) {
  const auto arm = six_joints();
  ASSERT_EQ(moving_joints(arm).size(), 6u);
  InverseKinematicsOptions options;
  options.wanted = 1;
  const InverseKinematics inverse(arm, options);
  std::mt19937 random(5);
  for (int i = 0; i < 100; ++i) {
    const auto tool = tool_pose(arm, random_configuration(arm, random));
    const auto solutions = inverse.solve(tool, arm.home);
    ASSERT_FALSE(solutions.empty()) << i;
    EXPECT_TRUE(within_limits(arm, solutions.front()));
    EXPECT_LT(error_of(arm, solutions.front(), tool), angle_precision);
  }
}

TEST(DampedLeastSquares, SolvesPosesOfTheKatanaToo) {
  const auto arm = katana();
  const KinematicChain chain(arm);
  std::mt19937 random(6);
  for (int i = 0; i < 50; ++i) {
    const auto tool = tool_pose(arm, random_configuration(arm, random));
    const auto solutions = solve_damped_least_squares(arm, chain, tool, arm.home, 1);
    ASSERT_FALSE(solutions.empty()) << i;
    EXPECT_LT(error_of(arm, solutions.front(), tool), angle_precision);
  }
}

} // namespace castor::manipulation
