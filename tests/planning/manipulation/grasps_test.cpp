#include "castor/planning/manipulation/grasps.hpp"

#include "castor/mapping/geometry/poses.hpp"
#include "castor/planning/manipulation/kinematics.hpp"
#include "castor/planning/manipulation/straight_motion.hpp"
#include "castor/tests/planning/manipulation/katana.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace castor::manipulation {

namespace {

using std::numbers::pi;
using ::testing::HasSubstr;

NamedSolid cube(double x, double y) {
  return thing("the cube", box(0.04, 0.04, 0.04), x, y, 0.02);
}

Point3 axis_of(const Pose& tool, const Point3& axis) {
  return geometry::rotate(tool.rotation, axis);
}

std::vector<Grasp> grasps_of(const Scene& scene, const std::string& name) {
  const auto arm = katana();
  const auto result = find_grasps(arm, InverseKinematics(arm), scene, name, arm.home);
  if (const auto* failure = std::get_if<MotionFailure>(&result)) {
    ADD_FAILURE() << failure->text;
    return {};
  }
  return std::get<std::vector<Grasp>>(result);
}

MotionFailure failure_of(const Scene& scene, const std::string& name) {
  const auto arm = katana();
  const auto result = find_grasps(arm, InverseKinematics(arm), scene, name, arm.home);
  EXPECT_TRUE(std::holds_alternative<MotionFailure>(result));
  return std::holds_alternative<MotionFailure>(result) ? std::get<MotionFailure>(result)
                                                       : MotionFailure{};
}

} // namespace

TEST(GraspCandidates, FingersCloseOnParallelFacesOfABox) {
  auto brick = thing("the brick", box(0.2, 0.05, 0.06), 0.25, 0.1, 0.03);
  brick.pose.rotation = geometry::rotation_about_z(0.4);
  const auto candidates = grasp_candidates(katana(), brick, true);
  ASSERT_FALSE(candidates.empty());
  for (const auto& x : candidates) {
    EXPECT_TRUE(x.width == 0.05 || x.width == 0.06) << x.width;
    const auto closing = axis_of(x.tool, {0, 1, 0});
    const double along_y = std::abs(-std::sin(0.4) * closing.x + std::cos(0.4) * closing.y);
    EXPECT_GT(x.width == 0.05 ? along_y : std::abs(closing.z), std::cos(0.18));
  }
}

TEST(GraspCandidates, OfABallComeFromAllTilts) {
  const auto candidates =
    grasp_candidates(katana(), thing("the ball", sphere(0.05), 0.2, 0.2, 0.025), true);
  for (double tilt : GraspOptions().tilts) {
    const auto found = std::ranges::find(candidates, tilt, &GraspCandidate::tilt);
    ASSERT_NE(found, candidates.end()) << tilt;
    EXPECT_NEAR(axis_of(found->tool, {0, 0, 1}).z, std::cos(tilt), 1e-9);
  }
}

TEST(GraspCandidates, HoldWhatIsRoundWhereItIsWidest) {
  const auto arm = katana();
  for (const auto& it : {thing("the ball", sphere(0.04), 0.2, 0.2, 0.02),
                         thing("the ball", sphere(0.06), 0.2, 0.2, 0.03)})
    for (const auto& x : grasp_candidates(arm, it, true)) {
      const auto tool = geometry::inverse(x.tool, "tool");
      const auto middle = geometry::transform(tool, it.pose.position);
      EXPECT_LT(std::abs(middle.x), arm.gripper->finger.x / 2);
      EXPECT_LT(middle.z, arm.gripper->beyond);
    }
}

TEST(GraspCandidates, OfABallAreBetweenThePadsOnlyAtItsMiddle) {
  const auto gripper = *katana().gripper;
  const auto ball = thing("the ball", sphere(0.05), 0.2, 0, 0.025);
  const auto can = thing("the can", cylinder(0.05, 0.09), 0.2, 0, 0.045);
  // From above: the tool's z axis down.
  const auto from_above = [](double z) { return Pose{{0.2, 0, z}, {0, 1, 0, 0}, arm_frame}; };
  EXPECT_TRUE(is_between_pads(gripper, ball, from_above(0.025), 0));
  EXPECT_TRUE(is_between_pads(gripper, ball, from_above(0.036), 0));
  EXPECT_FALSE(is_between_pads(gripper, ball, from_above(0.038), 0));
  EXPECT_FALSE(is_between_pads(gripper, ball, from_above(0.036), 0.002));
  EXPECT_TRUE(is_between_pads(gripper, can, from_above(0.085), 0));
  auto lying = can;
  lying.pose.rotation = geometry::rotation_from_axes({0, 1, 0}, {0, 0, 1}, {1, 0, 0});
  lying.pose.position.z = 0.025;
  EXPECT_TRUE(is_between_pads(gripper, lying, from_above(0.03), 0));
  EXPECT_FALSE(is_between_pads(gripper, lying, from_above(0.04), 0));
}

TEST(GraspCandidates, HaveRoomForPalmAndFingers) {
  const auto arm = katana();
  // Higher than fingers are long, and lower than they reach beyond the tool.
  for (double height : {0.15, 0.015}) {
    const auto candidates =
      grasp_candidates(arm, thing("it", box(0.04, 0.04, height), 0.2, 0, height / 2), true);
    const auto from_above = std::ranges::find(candidates, pi, &GraspCandidate::tilt);
    ASSERT_NE(from_above, candidates.end());
    const double z = from_above->tool.position.z;
    EXPECT_GT(z - arm.gripper->beyond, 0.005);
    EXPECT_GT(z + arm.gripper->finger.z - arm.gripper->beyond, height + 0.005);
    EXPECT_LT(z - arm.gripper->beyond, height);
  }
}

TEST(GraspCandidates, HaveRoomForThePalmAsHighAsTheThingMayBe) {
  const auto arm = katana();
  auto it = thing("it", cylinder(0.04, 0.07), 0.2, 0, 0.035);
  it.higher = 0.012;
  const auto candidates = grasp_candidates(arm, it, true);
  const auto from_above = std::ranges::find(candidates, pi, &GraspCandidate::tilt);
  ASSERT_NE(from_above, candidates.end());
  const double z = from_above->tool.position.z;
  EXPECT_GT(z + arm.gripper->finger.z - arm.gripper->beyond, 0.07 + 0.012 + 0.005);
  EXPECT_LT(z - arm.gripper->beyond, 0.07);
}

TEST(GraspCandidates, NeedAGripperThatOpensWide) {
  EXPECT_TRUE(
    grasp_candidates(katana(), thing("it", box(0.12, 0.12, 0.12), 0.2, 0, 0.06), true).empty());
  EXPECT_TRUE(grasp_candidates(six_joints(), cube(0.2, 0), false).empty());
}

TEST(Grasps, AreReachedWithoutContact) {
  const auto arm = katana();
  const Scene scene{
    {table_top(2, 2), cube(0.2, 0.1), thing("the can", cylinder(0.06, 0.1), 0.1, 0.22, 0.05)}, {}};
  for (const auto& name : {"the cube", "the can"}) {
    const auto grasps = grasps_of(scene, name);
    ASSERT_FALSE(grasps.empty());
    for (const auto& grasp : grasps) {
      const auto reached = tool_pose(arm, grasp.approach.back());
      EXPECT_LT(geometry::distance(reached.position, grasp.candidate.tool.position), 1e-9);
      const auto before = tool_pose(arm, grasp.approach.front());
      const double length = geometry::distance(before.position, reached.position);
      EXPECT_GE(length, 0.05 - 1e-9);
      // Fingers around the top of the can begin above it.
      EXPECT_LE(length, 0.12);
      if (length > 0.05 + 1e-9) {
        CollisionOptions open;
        open.opening = grasp.opening;
        EXPECT_TRUE(CollisionChecker(arm, scene, open).is_free(grasp.approach.front()));
      }
      CollisionOptions options;
      options.opening = grasp.opening;
      options.may_touch = {name};
      CollisionChecker checker(arm, scene, options);
      for (const auto& x : grasp.approach)
        EXPECT_TRUE(checker.is_free(x));
    }
    EXPECT_TRUE(std::ranges::is_sorted(grasps, std::ranges::greater(), &Grasp::score));
  }
}

TEST(Grasps, AvoidTheSideWhereSomethingStands) {
  // From above, fingers fit beside the cube in one direction only.
  const Scene scene{{table_top(2, 2), cube(0.22, 0),
                     thing("the left wall", box(0.1, 0.02, 0.1), 0.22, 0.04, 0.05),
                     thing("the right wall", box(0.1, 0.02, 0.1), 0.22, -0.04, 0.05)},
                    {}};
  for (const auto& grasp : grasps_of(scene, "the cube"))
    EXPECT_LT(std::abs(axis_of(grasp.candidate.tool, {0, 1, 0}).y), 0.2);
}

TEST(Grasps, NameWhatIsInTheWay) {
  const Scene scene{
    {table_top(2, 2), cube(0.22, 0), thing("the lid", box(0.3, 0.3, 0.02), 0.22, 0, 0.06)}, {}};
  const auto failure = failure_of(scene, "the cube");
  EXPECT_EQ(failure.kind, MotionFailureKind::goal_blocked);
  EXPECT_THAT(failure.text, HasSubstr("the lid"));
  EXPECT_THAT(failure.obstacles, ::testing::Contains("the lid"));
}

TEST(Grasps, SayThatAThingIsOutOfReachOrTooLarge) {
  const Scene scene{
    {table_top(4, 4), cube(1.5, 0), thing("the chest", box(0.3, 0.3, 0.3), 0.3, 0.2, 0.15)}, {}};
  const auto far = failure_of(scene, "the cube");
  EXPECT_EQ(far.kind, MotionFailureKind::out_of_reach);
  EXPECT_THAT(far.text, HasSubstr("1.50 m away, and the arm reaches 0.74 m"));
  const auto large = failure_of(scene, "the chest");
  EXPECT_EQ(large.kind, MotionFailureKind::no_grasp);
  EXPECT_THAT(large.text,
              HasSubstr("0.30 m wide where it is narrowest, and the gripper opens 0.10 m"));
  EXPECT_THROW(grasps_of(scene, "the moon"), std::invalid_argument);
}

TEST(StraightMotion, KeepsTheToolOnALine) {
  const auto arm = katana();
  const InverseKinematics inverse(arm);
  CollisionChecker checker(arm, {{table_top(2, 2)}, {}});
  const Pose begin{{0.2, 0.05, 0.12}, {0, 0, 1, 0}, arm_frame};
  auto end = begin;
  end.position.z = 0.05;
  const auto from = inverse.solve(begin, arm.home);
  ASSERT_FALSE(from.empty());
  const auto motion = straight_motion(arm, inverse, checker, from.front(), end);
  ASSERT_TRUE(motion);
  EXPECT_EQ(motion->size(), 8u);
  for (std::size_t i = 0; i < motion->size(); ++i) {
    const auto at = tool_pose(arm, (*motion)[i]).position;
    EXPECT_NEAR(at.x, 0.2, 1e-9);
    EXPECT_NEAR(at.z, 0.12 - 0.01 * static_cast<double>(i), 1e-9);
  }
  // Into the table.
  end.position.z = -0.05;
  EXPECT_FALSE(straight_motion(arm, inverse, checker, from.front(), end));
}

} // namespace castor::manipulation
