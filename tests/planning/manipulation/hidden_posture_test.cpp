#include "castor/planning/manipulation/hidden_posture.hpp"

#include "castor/mapping/geometry/camera_model.hpp"
#include "castor/mapping/geometry/poses.hpp"
#include "castor/planning/manipulation/arm_placement.hpp"
#include "castor/planning/manipulation/collision_checker.hpp"
#include "castor/tests/planning/manipulation/katana.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace castor::manipulation {

namespace {

/// Those of the PlayMate, in the frame of its arm.
geometry::Camera camera_above() {
  auto result = geometry::look_at({0, -0.34, 0.92}, {0, 0.02, 0}, 38, 640, 480, "table");
  const auto at = arm_placement("0 -0.37 heading 90");
  result.pose = geometry::compose(geometry::inverse(at, arm_frame), result.pose);
  return result;
}

Configuration aside_of(const ArmModel& arm) {
  return arm_posture(arm, "90 -20 110 60 90");
}

Scene laid_table() {
  return {{table_top(2, 2), thing("the ball", sphere(0.05), 0.3, 0.1, 0.025)}, {}};
}

TEST(HiddenPosture, TheArmIsInSightOverTheTableOnly) {
  const auto arm = katana();
  EXPECT_EQ(points_in_sight(arm, aside_of(arm), {}, camera_above()), 0U);
  EXPECT_GT(points_in_sight(arm, arm_posture(arm, "0 40 80 40 0"), {}, camera_above()), 100U);
  // What it holds reaches further.
  const NamedSolid globe{"the globe", sphere(1), {{}, {}, "tool"}};
  EXPECT_GT(points_in_sight(arm, aside_of(arm), globe, camera_above()), 0U);
}

TEST(HiddenPosture, IsTheOneThatIsWantedWhereJointsPermitIt) {
  const auto arm = katana();
  const auto eye = camera_above();
  const auto all = hidden_postures(arm, laid_table(), aside_of(arm), &eye);
  ASSERT_FALSE(all.empty());
  EXPECT_EQ(all.front(), aside_of(arm));
}

TEST(HiddenPosture, ThereIsOneWhateverJointStandsStill) {
  const auto arm = katana();
  const auto eye = camera_above();
  const std::vector<Configuration> places{arm_posture(arm, "0 30 80 40 0"),
                                          arm_posture(arm, "-40 50 60 50 30"),
                                          arm_posture(arm, "30 0 100 60 -60")};
  for (const auto& at : places)
    for (std::size_t joint = 0; joint < at.size(); ++joint) {
      const auto able = with_still_joint(arm, joint, at[joint]);
      const auto all = hidden_postures(able, laid_table(), aside_of(arm), &eye);
      ASSERT_FALSE(all.empty()) << "joint " << joint << " at " << at[joint];
      EXPECT_EQ(all.front()[joint], at[joint]);
      EXPECT_EQ(points_in_sight(arm, all.front(), {}, eye), 0U);
      EXPECT_FALSE(CollisionChecker(arm, laid_table()).contact(all.front()));
    }
}

} // namespace

} // namespace castor::manipulation
